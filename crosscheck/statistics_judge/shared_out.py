"""What stands in words beside a class that hangs on an interpretation."""

# From so many options on that have all of their results, these are counted and not listed.
MANY = 5


def shares(split: dict[str, list[int]]) -> str:
    """Under how many of its results each option is asked for."""
    looked = {option: own for option, own in split.items() if sum(own)}
    parted = {option: own for option, own in looked.items() if own[1]}
    whole = len(looked) - len(parted)
    is_short = whole >= MANY and bool(parted)
    listed = parted if is_short else looked
    each = ", ".join(f"{option} {own[0]} of {sum(own)}" for option, own in listed.items())
    return f"{each}; all under each of {whole} more" if is_short else each
