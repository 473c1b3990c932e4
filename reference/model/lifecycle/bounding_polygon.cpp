#include "reference/model/lifecycle/bounding_polygon.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace lockstep::lifecycle {
namespace {

constexpr double no_area = std::numeric_limits<double>::infinity();
using Point = glm::dvec2;

std::int64_t cross(LatticePoint o, LatticePoint a, LatticePoint b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}
double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }

/// A hull as the search sees it: edge i goes from vertex i to i + 1.
class Search {
  public:
    Search(std::span<const Point> hull, std::size_t k) : hull_(hull), n_(hull.size()), k_(k) {
        between_.assign(n_ * n_, no_area);
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t j = 0; j < n_; ++j)
                if (i != j)
                    between_[i * n_ + j] = meeting_area(i, j);
    }

    [[nodiscard]] std::optional<Bounding> least() const {
        // chains[h]: least area of h sides between edge i and edge j, and the last of them.
        std::vector<std::vector<double>> chains{between_};
        std::vector<std::vector<std::size_t>> last{{}};
        for (std::size_t h = 1; h + 3 <= k_; ++h) {
            std::vector<double> next(n_ * n_, no_area);
            std::vector<std::size_t> by(n_ * n_, n_);
            for (std::size_t i = 0; i < n_; ++i)
                for (std::size_t d = 2; d < n_; ++d) {
                    const std::size_t j = (i + d) % n_;
                    for (std::size_t e = 1; e < d; ++e) {
                        const std::size_t m = (i + e) % n_;
                        const double sum = chains.back()[i * n_ + m] + between_[m * n_ + j];
                        if (sum < next[i * n_ + j]) {
                            next[i * n_ + j] = sum;
                            by[i * n_ + j] = m;
                        }
                    }
                }
            chains.push_back(std::move(next));
            last.push_back(std::move(by));
        }
        double least = no_area;
        std::size_t from = 0, to = 0;
        for (std::size_t i = 0; i < n_; ++i)
            for (std::size_t j = 0; j < n_; ++j) {
                const double chain = i == j ? no_area : chains.back()[i * n_ + j];
                if (!(chain < least))
                    continue;
                const double sum = chain + closing(j, i).area;
                if (sum < least) {
                    least = sum;
                    from = i;
                    to = j;
                }
            }
        if (!(least < no_area))
            return {};
        std::vector<std::size_t> sides{to};
        for (std::size_t h = chains.size() - 1, j = to; h > 0; --h) {
            j = last[h][from * n_ + j];
            sides.push_back(j);
        }
        sides.push_back(from);
        std::reverse(sides.begin(), sides.end());
        return made(std::move(sides), closing(to, from), least);
    }

  private:
    /// The side between edge j and edge i that closes the polygon.
    struct Closing {
        double area = no_area;
        std::size_t flush = 0;
        std::optional<std::size_t> pivot;
        Point start{0.0}, end{0.0}; ///< of a balanced one
    };

    [[nodiscard]] Point edge(std::size_t i) const { return hull_[(i + 1) % n_] - hull_[i]; }

    [[nodiscard]] Point meeting(std::size_t i, std::size_t j) const {
        const Point a = hull_[i], u = edge(i), b = hull_[j], v = edge(j);
        return a + u * (cross(b - a, v) / cross(u, v));
    }

    /// Of vertices `first` to `last`, and the chord that closes them.
    [[nodiscard]] double chain_area(std::size_t first, std::size_t last) const {
        double twice = 0.0;
        const Point o = hull_[first];
        for (std::size_t v = first; v != last; v = (v + 1) % n_)
            twice += cross(hull_[v] - o, hull_[(v + 1) % n_] - o);
        return 0.5 * twice;
    }

    /// Between the hull and where the lines of edges i and j meet.
    [[nodiscard]] double meeting_area(std::size_t i, std::size_t j) const {
        if ((i + 1) % n_ == j)
            return 0.0;
        if (!(cross(edge(i), edge(j)) > 0.0))
            return no_area;
        const std::size_t first = (i + 1) % n_;
        const Point x = meeting(i, j), o = hull_[first];
        return 0.5 * cross(x - o, hull_[j] - o) - chain_area(first, j);
    }

    [[nodiscard]] Closing closing(std::size_t j, std::size_t i) const {
        Closing best;
        for (std::size_t m = (j + 1) % n_; m != i; m = (m + 1) % n_) {
            const double sum = between_[j * n_ + m] + between_[m * n_ + i];
            if (sum < best.area)
                best = {sum, m, {}, {}, {}};
        }
        // A side that is halved at vertex p: line i, turned about p, meets line j at its start.
        const Point u = edge(j), v = edge(i);
        const double turn = cross(u, v);
        if (turn == 0.0)
            return best;
        for (std::size_t p = (j + 1) % n_;; p = (p + 1) % n_) {
            const Point pivot = hull_[p], mirrored = pivot * 2.0 - hull_[i];
            const Point start = hull_[j] + u * (cross(mirrored - hull_[j], v) / turn), end = pivot * 2.0 - start;
            const Point side = end - start, before = edge((p + n_ - 1) % n_), after = edge(p);
            if (cross(before, side) >= 0.0 && cross(side, after) >= 0.0 && cross(u, side) > 0.0 &&
                cross(side, v) > 0.0) {
                const std::size_t first = (j + 1) % n_;
                const Point o = hull_[first];
                const double outer = 0.5 * (cross(start - o, end - o) + cross(end - o, hull_[i] - o));
                const double sum = outer - chain_area(first, i);
                if (sum < best.area)
                    best = {sum, 0, p, start, end};
            }
            if (p == i)
                break;
        }
        return best;
    }

    [[nodiscard]] Bounding made(std::vector<std::size_t> sides, const Closing& closing_side, double least) const {
        Bounding found;
        for (std::size_t s = 0; s + 1 < sides.size(); ++s)
            found.corners.push_back(meeting(sides[s], sides[s + 1]));
        if (closing_side.pivot) {
            found.corners.push_back(closing_side.start);
            found.corners.push_back(closing_side.end);
        } else {
            found.corners.push_back(meeting(sides.back(), closing_side.flush));
            found.corners.push_back(meeting(closing_side.flush, sides.front()));
            sides.push_back(closing_side.flush);
        }
        found.flush = std::move(sides);
        found.pivot = closing_side.pivot;
        found.area = area(hull_) + least;
        return found;
    }

    std::span<const Point> hull_;
    std::size_t n_, k_;
    std::vector<double> between_; ///< of edges i and j
};

constexpr std::int64_t units = 2048; ///< of 1/4096 texel, in a half texel

std::vector<glm::dvec2> rectangle(std::span<const LatticePoint> hull) {
    const auto [left, right] = std::minmax_element(hull.begin(), hull.end(), [](auto a, auto b) { return a.x < b.x; });
    const auto [low, high] = std::minmax_element(hull.begin(), hull.end(), [](auto a, auto b) { return a.y < b.y; });
    const double x0 = 0.5 * double(left->x), x1 = 0.5 * double(right->x), y0 = 0.5 * double(low->y),
                 y1 = 0.5 * double(high->y);
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// The sides that leave a point of the hull outside, all in 1/4096 texel.
std::vector<std::size_t> violated(const std::vector<LatticePoint>& corners, std::span<const LatticePoint> hull) {
    std::vector<std::size_t> all;
    for (std::size_t c = 0; c < corners.size(); ++c)
        if (std::any_of(hull.begin(), hull.end(), [&](LatticePoint p) {
                return cross(corners[c], corners[(c + 1) % corners.size()], {p.x * units, p.y * units}) < 0;
            }))
            all.push_back(c);
    return all;
}

} // namespace

std::vector<LatticePoint> outermost(std::span<const std::uint8_t> alpha, int size, int cut, HullPoints points) {
    std::vector<LatticePoint> all;
    for (int y = 0; y < size; ++y) {
        int first = size, last = -1;
        for (int x = 0; x < size; ++x)
            if (alpha[static_cast<std::size_t>(y * size + x)] > cut) {
                first = std::min(first, x);
                last = x;
            }
        if (last < 0)
            continue;
        const std::int64_t left = 2 * first + 1, right = 2 * last + 1, middle = 2 * y + 1;
        const std::int64_t reach = points == HullPoints::centres ? 0 : points == HullPoints::corners ? 1 : 2;
        for (const std::int64_t dy : {-reach, reach}) {
            all.push_back({left - reach, middle + dy});
            all.push_back({right + reach, middle + dy});
        }
    }
    return all;
}

std::vector<LatticePoint> convex_hull(std::vector<LatticePoint> points) {
    if (points.empty())
        return points;
    const auto lowest = std::min_element(points.begin(), points.end(), [](LatticePoint a, LatticePoint b) {
        return a.y != b.y ? a.y < b.y : a.x < b.x;
    });
    std::iter_swap(points.begin(), lowest);
    const LatticePoint o = points.front();
    const auto far = [&](LatticePoint p) { return std::abs(p.x - o.x) + std::abs(p.y - o.y); };
    std::sort(points.begin() + 1, points.end(), [&](LatticePoint a, LatticePoint b) {
        const std::int64_t turn = cross(o, a, b);
        return turn != 0 ? turn > 0 : far(a) < far(b);
    });
    std::vector<LatticePoint> hull;
    for (const LatticePoint p : points) {
        if (!hull.empty() && hull.back() == p)
            continue;
        while (hull.size() > 1 && cross(hull[hull.size() - 2], hull.back(), p) <= 0)
            hull.pop_back();
        hull.push_back(p);
    }
    if (hull.size() > 2 && cross(hull[hull.size() - 2], hull.back(), o) <= 0)
        hull.pop_back();
    return hull;
}

double area(std::span<const glm::dvec2> polygon) {
    double twice = 0.0;
    for (std::size_t c = 0; c < polygon.size(); ++c)
        twice += cross(polygon[c] - polygon[0], polygon[(c + 1) % polygon.size()] - polygon[0]);
    return 0.5 * twice;
}

std::optional<Bounding> least_polygon(std::span<const glm::dvec2> hull, std::size_t k) {
    if (k < 3 || hull.size() < 3)
        return {};
    if (hull.size() <= k) {
        Bounding all{{hull.begin(), hull.end()}, area(hull), {}, {}};
        for (std::size_t e = 0; e < hull.size(); ++e)
            all.flush.push_back(e);
        return all;
    }
    return Search(hull, k).least();
}

std::vector<glm::dvec2> sprite_polygon(std::span<const LatticePoint> hull, std::size_t k) {
    if (hull.empty())
        return {};
    std::vector<glm::dvec2> exact;
    for (const LatticePoint p : hull)
        exact.emplace_back(0.5 * double(p.x), 0.5 * double(p.y));
    const std::optional<Bounding> found = least_polygon(exact, k);
    if (!found)
        return rectangle(hull);
    Point middle(0.0);
    for (const Point c : found->corners)
        middle += c / double(found->corners.size());
    std::vector<LatticePoint> corners;
    for (const Point c : found->corners) {
        const auto outwards = [](double x, double from) {
            return static_cast<std::int64_t>(x < from ? std::floor(x * 4096.0) : std::ceil(x * 4096.0));
        };
        corners.push_back({outwards(c.x, middle.x), outwards(c.y, middle.y)});
    }
    for (int turn = 0; turn < 8; ++turn) {
        const std::vector<std::size_t> wrong = violated(corners, hull);
        if (wrong.empty())
            break;
        for (const std::size_t side : wrong)
            for (const std::size_t c : {side, (side + 1) % corners.size()}) {
                corners[c].x += double(corners[c].x) < middle.x * 4096.0 ? -1 : 1;
                corners[c].y += double(corners[c].y) < middle.y * 4096.0 ? -1 : 1;
            }
    }
    if (!violated(corners, hull).empty())
        return rectangle(hull);
    std::rotate(corners.begin(),
                std::min_element(corners.begin(), corners.end(),
                                 [](LatticePoint a, LatticePoint b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }),
                corners.end());
    std::vector<glm::dvec2> texels;
    for (const LatticePoint c : corners)
        texels.emplace_back(double(c.x) / 4096.0, double(c.y) / 4096.0);
    return texels;
}

} // namespace lockstep::lifecycle
