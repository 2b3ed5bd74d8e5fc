"""Delta debugging (Zeller): a smallest part of a list that still fails."""


def smallest(items, fails, most=200):
    """A part of items for which fails() is true, from which no single one can go; at most so many trials."""
    items, n, trials = list(items), 2, 0
    if not items:
        return items
    while len(items) >= 1 and trials < most:
        size = max(1, len(items) // n)
        reduced = False
        for start in range(0, len(items), size):
            rest = items[:start] + items[start + size:]
            trials += 1
            if fails(rest):
                items, reduced = rest, True
                n = max(n - 1, 2)
                break
            if trials >= most:
                return items
        if not reduced:
            if size == 1:
                break
            n = min(2 * n, len(items))
    return items
