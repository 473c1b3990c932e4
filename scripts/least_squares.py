"""Linear fits in proportion, without packages."""


def least_squares(rows):
    """Factors of each row's numbers but its last, whose sums miss the last by least in proportion; by how much each does."""
    rows = [[x / row[-1] for x in row] for row in rows]
    n = len(rows[0]) - 1
    normal = [[sum(row[i] * row[j] for row in rows) for j in range(n + 1)] for i in range(n)]
    for i in range(n):
        normal[i] = [x / normal[i][i] for x in normal[i]]
        for j in set(range(n)) - {i}:
            normal[j] = [x - normal[j][i] * y for x, y in zip(normal[j], normal[i])]
    factors = [row[n] for row in normal]
    return factors, [abs(sum(f * x for f, x in zip(factors, row)) - 1.0) for row in rows]
