"""What the cost of a system follows in the number of its nodes: laws that are fitted to measured systems. Pure."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Law:
    """constant + linear n + square n^2"""

    constant: float = 0.0
    linear: float = 0.0
    square: float = 0.0

    def at(self, n):
        return self.constant + self.linear * n + self.square * n * n


def fit(figures, powers):
    """The law with these powers of n that deviates least from the figures, {n: value}, as shares of them, and has no
    negative term: a cost that a term would take away again is none."""
    powers = sorted(powers)
    while True:
        terms = _least_squares([[n**p / y for p in powers] for n, y in figures.items() if y > 0])
        if all(x >= 0 for x in terms) or len(powers) == 1:
            break
        powers = [p for p, x in zip(powers, terms) if x >= 0] or powers[:1]
    found = dict(zip(powers, terms))
    return Law(*(max(found.get(p, 0.0), 0.0) for p in (0, 1, 2)))


def deviation(law, figures):
    """The greatest deviation of a law from the figures, as a share of them."""
    return max(abs(law.at(n) / y - 1) for n, y in figures.items() if y > 0)


def _least_squares(rows):
    """x so that each row's product with it is nearest to 1."""
    size = len(rows[0])
    matrix = [[sum(r[i] * r[j] for r in rows) for j in range(size)] + [sum(r[i] for r in rows)] for i in range(size)]
    for i in range(size):
        pivot = max(range(i, size), key=lambda k, i=i: abs(matrix[k][i]))
        matrix[i], matrix[pivot] = matrix[pivot], matrix[i]
        for k in range(size):
            if k != i:
                factor = matrix[k][i] / matrix[i][i]
                matrix[k] = [x - factor * y for x, y in zip(matrix[k], matrix[i])]
    return [matrix[i][size] / matrix[i][i] for i in range(size)]
