"""What stands in words beside a class that hangs on an interpretation."""

from fractions import Fraction

# From so many options on that have all of their results on one side, these are counted while others are left to list.
MANY = 5


def shares(split: dict[str, list[int]]) -> str:
    """How many results of each option are against, the largest share first."""
    listed = {option: own for option, own in split.items() if sum(own)}
    sides = [
        (sum(own[lacking] == 0 for own in listed.values()), lacking, word)
        for lacking, word in ((1, "all"), (0, "none"))
    ]
    counted = []
    for count, lacking, word in sorted(sides, key=lambda side: -side[0]):
        if MANY <= count < len(listed):
            listed = {option: own for option, own in listed.items() if own[lacking]}
            counted.append(f"{word} with each of {count} more")
    shares_first = sorted(listed.items(), key=lambda one: -Fraction(one[1][0], sum(one[1])))
    each = [f"{own[0]} of {sum(own)} with {option}" for option, own in shares_first]
    each[:1] = [one.replace(" with ", " against with ", 1) for one in each[:1]]
    return ", ".join(each + counted)
