"""Rules for ranges and lattices: why spans of printed numbers contradict each other."""

from __future__ import annotations

from fractions import Fraction
from math import floor, isqrt

from certificates.counting import fraction, integer, positive
from certificates.spans import Span, need, point


def order(spans: list[Span], given: dict, steps: list) -> None:
    """A number that may not be above another is."""
    low, high = given["pair"]
    need(min(low, high) >= 0, "the pair is wrong")
    # The share of values below each; none is the mean, which only the ends have an order with.
    p, q = (fraction(rank) for rank in given["ranks"])
    if p is None or q is None:
        need(p == 0 or q == 1, "the mean has no order with that")
    else:
        need(0 <= p < q <= 1, "the pair is not one that has an order")
    said = {"at_least": str(spans[low].low), "at_most": str(spans[high].high)}
    need(steps == [said], f"the numbers are {said}")
    need(spans[low].low > spans[high].high, "the pair may stand in order")


def sd_range(spans: list[Span], given: dict, steps: list) -> None:
    """The deviation is above the most, or below the least, that mean and range allow."""
    n, divisor = integer(given["n"]), given["divisor"]
    need(divisor in ("sample", "population", "either"), "there is no such divisor")
    need((n is None or n > 1) and len(steps) == 1, "n or the steps are wrong")
    said = steps[0]
    if set(said) == {"at_most"}:
        need(len(spans) == 1 and n is None and given["ends"] is None, "a number below 0 needs no others")
        need(divisor == "either" and fraction(said["at_most"]) == spans[0].high, "the most is another")
        need(spans[0].cut(Fraction(0), None).is_empty(), "the deviation may be 0 or more")
        return
    factor = Fraction(1)
    if divisor != "population":
        factor = Fraction(2) if n is None else Fraction(n, n - 1)
    ends = given["ends"]
    least, most = spans[2:] if ends is None else [point(fraction(end)) for end in ends]
    if set(said) == {"squared_at_least", "most"}:
        at = min(max((least.low + most.high) / 2, spans[1].low), spans[1].high)
        bound = max(Fraction(0), (most.high - at) * (at - least.low)) * factor
        need(fraction(said["most"]) == bound, f"the most is {bound}")
        low = spans[0].squared().low
        need(fraction(said["squared_at_least"]) == low and low > bound, "the deviation may be that small")
    else:
        need(set(said) == {"squared_at_most", "least"} and ends is None and n is not None, "a step is wrong")
        spread = max(Fraction(0), most.low - least.high)
        bound = spread**2 / (2 * (n - 1 if divisor == "sample" else n))
        high = spans[0].squared().high
        need(fraction(said["least"]) == bound, f"the least is {bound}")
        need(fraction(said["squared_at_most"]) == high and high < bound, "the deviation may be that large")


def sum_of_means(spans: list[Span], given: dict, steps: list) -> None:
    """The total is not what the parts allow."""
    cut = fraction(given["cut"])
    need(cut is None or cut > 0, "the cut is not above 0")
    allowed = point(Fraction(0))
    for part in spans[1:]:
        allowed = allowed.plus(part)
    if cut is not None:
        allowed = allowed.plus(Span(Fraction(0), True, cut * (len(spans) - 2), True))
    need(len(spans) > 1 and steps == [{"sum": allowed.written()}], f"the sum is {allowed.written()}")
    need(not allowed.meets(spans[0]), "the total may be the sum")


def total_over_mean(spans: list[Span], given: dict, steps: list) -> None:
    """The total over the mean is no whole number, or not the one given."""
    quotient = spans[0].times(positive(given["unit"])).over(spans[1])
    n = integer(given["n"])
    said = {"quotient": quotient.written(), "excludes": "every whole number above 0" if n is None else str(n)}
    need(len(spans) == 2 and steps == [said], f"the quotient is {said}")
    first, last = quotient.integers()
    need(max(first, 1) > last if n is None else not quotient.contains(Fraction(n)), "the quotient may be n")


def formed(names: set[str]) -> object:
    """The rule for a number made of two cells in one of the forms `names`."""

    def rule(spans: list[Span], given: dict, steps: list) -> None:
        value, a, b = spans
        forms = given["forms"]
        need(forms and set(forms) <= names, "the forms are wrong")
        need([step["form"] for step in steps] == forms, "the forms are not all looked at")
        for step in steps:
            span = form(step["form"], a, b)
            need(step == {"form": step["form"], "span": span.written()}, f"the span is {span.written()}")
            need(not span.meets(value), "the number may be that")

    return rule


def form(name: str, a: Span, b: Span) -> Span:
    """What two cells allow a number to be."""
    minus_one = point(Fraction(-1))
    if name == "100(a-b)/a":
        left = b.over(a).times(Fraction(100))
        return Span(100 - left.high, left.high_closed, 100 - left.low, left.low_closed)
    quotient = a.over(b)
    if name == "100(a-b)/b":
        return quotient.plus(minus_one).times(Fraction(100))
    return quotient.plus(minus_one) if name == "a/b-1" else quotient


def shares_sum(spans: list[Span], given: dict, steps: list) -> None:
    """The shares do not sum to the whole, or no counts of n do."""
    whole, n = positive(given["whole"]), integer(given["n"])
    need(len(steps) == 1 and len(spans) > 0, "one step is needed")
    if set(steps[0]) == {"sum", "misses"}:
        total = point(Fraction(0))
        for span in spans:
            total = total.plus(span)
        need(n is None and steps[0]["sum"] == total.written(), f"the sum is {total.written()}, without n")
        need(steps[0]["misses"] == str(whole), f"the whole is {whole}")
        need(not total.contains(whole), "the sum may be the whole")
        return
    counts = [span.times(n / whole).integers() for span in spans]
    written = [[str(first), str(last)] for first, last in counts]
    need(steps[0] == {"counts": written, "of": [str(n), str(whole)]}, f"the counts are {written}")
    first, last = sum(first for first, _ in counts), sum(last for _, last in counts)
    need(any(a > b for a, b in counts) or n < first or n > last, "counts may sum to n")


def expansions(spans: list[Span], given: dict, steps: list) -> None:
    """The count is outside of 0 to the number of free cells."""
    free = integer(given["free"])
    past = max(spans[0].low - free, -spans[0].high)
    need(len(spans) == 1 and steps == [{"outside_by": str(past)}], f"the count is outside by {past}")
    need(spans[0].cut(Fraction(0), Fraction(free)).is_empty(), "the count is not outside")


def rises(spans: list[Span], given: dict, steps: list) -> None:
    """The share at more samples is below the one at fewer."""
    more, fewer = spans
    said = {"fewer_at_least": str(fewer.low), "more_at_most": str(more.high)}
    need(given == {} and steps == [said] and fewer.low > more.high, "the share may rise")


def root_sign(a: Fraction, b: Fraction) -> int:
    """The sign of a + b √2."""
    if a >= 0 and b >= 0:
        return int(a > 0 or b > 0)
    if a <= 0 and b <= 0:
        return -1
    larger = a * a > 2 * b * b
    return 1 if larger == (a > 0) else -1


def joins(straight: int, diagonal: int, displacement: list[int]) -> bool:
    """Whether such moves cover the displacement: each axis needs enough moves of the right parity."""
    dx, dy = map(abs, displacement)

    def reaches(moves: int, distance: int) -> bool:
        return moves >= distance and (moves - distance) % 2 == 0

    across = range(straight + 1)
    return any(reaches(h + diagonal, dx) and reaches(straight - h + diagonal, dy) for h in across)


def lengths(span: Span, diagonal: Fraction | None, displacement: list[int] | None) -> list[tuple[int, int]]:
    """Every pair of move counts whose length is in the span, in steps."""
    found = []
    high = span.high
    most = max(0, floor(high / (diagonal or 1)))
    for count in range(most + 1):
        if diagonal is None:
            # The root of 2 count² lies between two whole numbers; candidates are tried exactly.
            root = isqrt(2 * count * count)
            candidates = range(max(0, floor(span.low) - root - 1), max(0, floor(high) - root + 1) + 1)
        else:
            candidates = range(
                max(0, floor(span.low - count * diagonal)), max(0, floor(high - count * diagonal)) + 1
            )
        for straight in candidates:
            if diagonal is None:
                below = root_sign(straight - span.low, Fraction(count))
                above = root_sign(straight - high, Fraction(count))
            else:
                length = straight + count * diagonal
                below, above = (length > span.low) - (length < span.low), (length > high) - (length < high)
            fits = (below > 0 or (below == 0 and span.low_closed)) and (
                above < 0 or (above == 0 and span.high_closed)
            )
            if fits and (displacement is None or joins(straight, count, displacement)):
                found.append((straight, count))
    return found


def cells_apart(given: list) -> list[int]:
    """Two whole numbers of cells."""
    need(isinstance(given, list) and len(given) == 2 and None not in given, "a displacement has two numbers")
    return [integer(cells) for cells in given]


def lattice(spans: list[Span], given: dict, steps: list) -> None:
    """No straight and diagonal moves are as long: all are tried."""
    step, diagonal = positive(given["step"]), fraction(given["diagonal"])
    need(diagonal is None or diagonal > 0, "the diagonal is not above 0")
    displacement = given["displacement"]
    displacement = None if displacement is None else cells_apart(displacement)
    span = spans[0].times(1 / step)
    most = floor(max(span.high, Fraction(0)) / min(Fraction(1), diagonal or Fraction(1)) + 1)
    need(len(spans) == 1 and steps == [{"moves_at_most": str(most)}], f"there are at most {most} moves")
    found = lengths(span, diagonal, displacement)
    need(not found, f"{found[:1]} is printed so")


def path_bound(spans: list[Span], given: dict, steps: list) -> None:
    """The longest value is below the bound a + √b."""
    dx, dy = (fraction(apart) for apart in given["apart"])
    need(dx >= 0 and dy >= 0 and len(spans) == 1, "the ends are wrong")
    short, long = sorted((dx, dy))
    bounds = {
        "any": (Fraction(0), dx**2 + dy**2),
        "four": (dx + dy, Fraction(0)),
        "eight": (long - short, 2 * short**2),
    }
    a, b = bounds[given["moves"]]
    need(steps == [{"plus": str(a), "root_of": str(b)}], f"the bound is {a} + √{b}")
    rest = spans[0].high - a
    need(rest < 0 or rest**2 < b, "the length may be that long")


MOVES = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)]


def turn_sums(straight: int, diagonal: int, displacement: list[int]) -> set[int]:
    """Every turn sum of such moves over the displacement, in degrees, of both conventions."""
    sums = set()
    for is_interior in (False, True):
        walks = {((0, 0), None, straight, diagonal): {0}}
        for _ in range(straight + diagonal):
            longer: dict = {}
            for ((x, y), last, s, d), turns in walks.items():
                for move, (dx, dy) in enumerate(MOVES):
                    rest = (s, d - 1) if move % 2 else (s - 1, d)
                    left = [displacement[0] - x - dx, displacement[1] - y - dy]
                    if min(rest) < 0 or not joins(*rest, left):
                        continue
                    change = 0 if last is None else min(abs(move - last), 8 - abs(move - last))
                    bend = (4 - change if change else 0) if is_interior and last is not None else change
                    at = ((x + dx, y + dy), move, *rest)
                    longer.setdefault(at, set()).update(turn + bend for turn in turns)
            walks = longer
        for ((x, y), *_), turns in walks.items():
            if [x, y] == displacement:
                sums |= {45 * turn for turn in turns}
    return sums


def turn_sum(spans: list[Span], given: dict, steps: list) -> None:
    """No 8-connected path of the length has the turn sum: all sums are enumerated."""
    turns, length = spans
    displacement = cells_apart(given["displacement"])
    found = lengths(length, None, displacement)
    said = steps[0]
    need(len(steps) == 1 and set(said) == {"moves", "sums_deg"}, "a step has other fields")
    listed = {(integer(s), integer(d)) for s, d in said["moves"]}
    need(listed == set(found) and all(s + d <= 31 for s, d in found), f"the moves are {found}")
    sums = set().union(*(turn_sums(s, d, displacement) for s, d in found))
    need(said["sums_deg"] == [str(total) for total in sorted(sums)], f"the sums are {sorted(sums)}")
    need(not any(turns.contains(Fraction(total)) for total in sums), "a turn sum is printed so")


def ratio_label(spans: list[Span], given: dict, steps: list) -> None:
    """More problems have b at most A / R than there are below B."""
    n = integer(given["n"])
    # The quantile of each of the three that contradict each other: which number it is, and its share.
    r, a, b = (given[name][0] for name in "rab")
    p, q, s = (fraction(given[name][1]) for name in "rab")
    need(n > 0 and len({r, a, b}) == 3 and min(r, a, b) >= 0, "n or the quantiles are wrong")
    need(all(0 <= share <= 1 for share in (p, q, s)), "a share is not from 0 to 1")

    def slack(share: Fraction) -> int:
        return 0 if share in (0, 1) else 1

    need(spans[r].low > 0, "the quotient may be 0")
    bound = spans[a].high / spans[r].low
    at_least = (n - n * p - slack(p)) + (n * q - slack(q)) - n
    at_most = n - 1 if s == 1 else n * s + slack(s)
    below = spans[b].low
    said = {"bound": bound, "below": below, "at_least": at_least, "at_most": at_most}
    said = {name: str(number) for name, number in said.items()}
    need(steps == [said], f"the counts are {said}")
    need(bound < below and at_least > at_most, "the counts do not contradict each other")


RULES = {
    "order": (order, {"pair", "ranks"}),
    "sd_range": (sd_range, {"n", "divisor", "ends"}),
    "sum_of_means": (sum_of_means, {"cut"}),
    "total_over_mean": (total_over_mean, {"n", "unit"}),
    "ratio": (formed({"a/b"}), {"forms"}),
    "speedup": (formed({"a/b", "a/b-1"}), {"forms"}),
    "reduction": (formed({"100(a-b)/a", "100(a-b)/b"}), {"forms"}),
    "shares_sum": (shares_sum, {"whole", "n"}),
    "expansions": (expansions, {"free"}),
    "rises": (rises, set()),
    "lattice": (lattice, {"step", "diagonal", "displacement"}),
    "path_bound": (path_bound, {"apart", "moves"}),
    "turn_sum": (turn_sum, {"displacement"}),
    "ratio_label": (ratio_label, {"n", "r", "a", "b"}),
}
