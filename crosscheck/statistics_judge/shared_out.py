"""What stands in words beside a class that hangs on an interpretation."""

# From so many options on that have all of their results on one side, these are counted while others are left to list.
MANY = 5


def shares(split: dict[str, list[int]]) -> str:
    """Under how many of its results each option is asked for."""
    listed = {option: own for option, own in split.items() if sum(own)}
    sides = [
        (sum(own[lacking] == 0 for own in listed.values()), lacking, word)
        for lacking, word in ((1, "all"), (0, "none"))
    ]
    counted = []
    for count, lacking, word in sorted(sides, key=lambda side: -side[0]):
        if MANY <= count < len(listed):
            listed = {option: own for option, own in listed.items() if own[lacking]}
            counted.append(f"{word} under each of {count} more")
    each = ", ".join(f"{option} {own[0]} of {sum(own)}" for option, own in listed.items())
    return f"{each}; {', '.join(counted)}" if counted else each
