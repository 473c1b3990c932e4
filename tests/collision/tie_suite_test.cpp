#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>

#include "reference/collision/legal_outcomes.hpp"
#include "reference/collision/legal_texels.hpp"
#include "reference/model/same_bits.hpp"
#include "reference/window.hpp"
#include "tests/collision/collision_scenes.hpp"

namespace lockstep::test::tie_suite_test {

namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr int size = 64;
constexpr int ties_of_a_kind = 10'000;

float moved(float x, int ulps) {
    for (; ulps > 0; --ulps)
        x = std::nextafter(x, inf);
    for (; ulps < 0; ++ulps)
        x = std::nextafter(x, -inf);
    return x;
}

/// A driver that uses every freedom GLSL gives it, at random; the listing once more, on its own terms.
class RandomDriver {
  public:
    explicit RandomDriver(Random& random) : random_(random) {}

    float divide(float a, float b) { return within(2.5, double{a} / double{b}); }

    ParticleState step(const ParticleState& a, const CollisionImage& cdt, const FrameParams& params) {
        if (a.collide_time < 0.0F && !(std::abs(a.collide_time) < std::numeric_limits<float>::min() && coin())) {
            const glm::mat4& m = params.collision_proj_view;
            const auto row = [&](int r) {
                return ((m[0][r] * a.position.x + m[1][r] * a.position.y) + m[2][r] * a.position.z) + m[3][r];
            };
            const float w = row(3);
            const float x = (divide(row(0), w) + 1.0F) * 0.5F * static_cast<float>(params.width);
            const float y = (divide(row(1), w) + 1.0F) * 0.5F * static_cast<float>(params.height);
            if (x >= 0.0F && y >= 0.0F && x < static_cast<float>(params.width) && y < static_cast<float>(params.height))
                if (const auto away = nearest(a.position, static_cast<int>(x), static_cast<int>(y), cdt, params))
                    return hit(a, *away, params);
        }
        return fall(a, params);
    }

    ParticleState hit(const ParticleState& a, glm::vec3 away, const FrameParams& params) {
        ParticleState v;
        v.direction = normalize(away);
        v.speed = a.speed * params.switches.speed_factor;
        v.collide_time = params.constants.collision_time;
        v.position = a.position + v.direction * v.speed * params.constants.tick;
        return v;
    }

    ParticleState fall(const ParticleState& a, const FrameParams& params) {
        const glm::vec3 velocity = a.direction * a.speed + params.constants.gravity * params.constants.tick;
        ParticleState v;
        v.direction = normalize(velocity);
        v.speed = length(velocity);
        v.collide_time = a.collide_time - params.constants.tick;
        v.position = a.position + v.direction * v.speed * params.constants.tick;
        return v;
    }

  private:
    bool coin() { return random_.below(2) == 0; }

    /// Any float at most `ulps` from the exact value.
    float within(double ulps, double exact) {
        const auto nearest = static_cast<float>(exact);
        const double unit = double{std::nextafter(std::abs(nearest), inf)} - std::abs(nearest);
        for (int tries = 0; tries < 8; ++tries) {
            const float candidate = moved(nearest, static_cast<int>(random_.below(7)) - 3);
            if (std::abs(double{candidate} - exact) <= ulps * unit * 0.999)
                return candidate;
        }
        return nearest;
    }

    float inverse_sqrt(float x) { return within(2.0, 1.0 / std::sqrt(double{x})); }
    float squared(glm::vec3 v) {
        switch (random_.below(3)) {
        case 0:
            return (v.x * v.x + v.y * v.y) + v.z * v.z;
        case 1:
            return v.x * v.x + (v.y * v.y + v.z * v.z);
        default:
            return std::fma(v.z, v.z, std::fma(v.y, v.y, v.x * v.x));
        }
    }
    float length(glm::vec3 v) {
        const float square = squared(v);
        return coin() ? std::sqrt(square) : divide(1.0F, inverse_sqrt(square));
    }
    glm::vec3 normalize(glm::vec3 v) {
        const float s = inverse_sqrt(squared(v));
        return {v.x * s, v.y * s, v.z * s};
    }

    std::optional<glm::vec3> nearest(glm::vec3 own, int base_x, int base_y, const CollisionImage& cdt,
                                     const FrameParams& params) {
        float best = 100000.0F;
        std::optional<glm::vec3> away;
        const int reach = params.constants.texel_collide_range;
        for (int y = base_y - reach; y <= base_y + reach; ++y)
            for (int x = base_x - reach; x <= base_x + reach; ++x) {
                if ((x == base_x && y == base_y) || !cdt.contains(x, y) || cdt.at(x, y).a == 0.0F)
                    continue;
                const glm::vec3 apart = own - glm::vec3(cdt.at(x, y));
                const float distance = length(apart);
                if (distance != 0.0F && params.constants.collision_range > distance && distance < best) {
                    best = distance;
                    away = apart;
                }
            }
        return away;
    }

    Random& random_;
};

/// A particle and a CDT made for it.
struct Constructed {
    FrameParams params;
    ParticleState before;
    CollisionImage cdt{size, size};
    std::vector<glm::vec3> wrong; ///< positions that must not be collided with
    bool may_miss = false;

    Constructed() {
        params.width = params.height = size;
        params.constants.collision_range = 0.5F;
        params.constants.texel_collide_range = 1;
        params.collision_proj_view[3][3] = 3.0F; // clip w is 3 everywhere, so that x / w has something to round
        before = {{0.1F, -0.2F, 0.0F}, {0.6F, 0.8F, 0.0F}, 0.75F, -0.25F};
    }

    void store(int x, int y, glm::vec3 position) { cdt.at(x, y) = glm::vec4(position, 1.0F); }
};

/// What the suite has seen.
struct Tally {
    int ties = 0, more_than_one = 0, accepted = 0, rejected = 0;
    std::map<std::size_t, int> set_sizes;

    [[nodiscard]] std::size_t median_set_size() const {
        int below = 0;
        for (const auto& [outcomes, count] : set_sizes)
            if (2 * (below += count) >= ties)
                return outcomes;
        return 0;
    }
    [[nodiscard]] std::size_t largest_set() const { return set_sizes.rbegin()->first; }
};

bool is_legal(const Constructed& tie, const ParticleState& state) {
    const auto outcomes =
        legal_outcomes(tie.before, tie.cdt, tie.params, named_profile("strict"), KnownOperations{}, &state);
    return std::any_of(outcomes.begin(), outcomes.end(), [&](const LegalOutcome& o) { return o.contains(state); });
}

/// Every run of a random driver is legal; runs with a wrong decision, with fields of two runs, or with one field off by
/// a little are not.
void judge(const Constructed& tie, Random& random, Tally& tally) {
    RandomDriver driver(random);
    const auto outcomes =
        legal_outcomes(tie.before, tie.cdt, tie.params, named_profile("strict"), KnownOperations{}, nullptr);
    ++tally.ties;
    tally.more_than_one += outcomes.size() > 1;
    ++tally.set_sizes[outcomes.size()];
    const ParticleState first = driver.step(tie.before, tie.cdt, tie.params);
    for (int run = 0; run < 4; ++run) {
        const ParticleState state = driver.step(tie.before, tie.cdt, tie.params);
        REQUIRE(is_legal(tie, state));
        ++tally.accepted;
        ParticleState mixed = first;
        mixed.position = state.position;
        if (std::abs(glm::dot(first.direction, state.direction)) < 0.99F) {
            REQUIRE_FALSE(is_legal(tie, mixed));
            ++tally.rejected;
        }
    }
    const auto reject = [&](const ParticleState& state) {
        REQUIRE_FALSE(is_legal(tie, state));
        ++tally.rejected;
    };
    for (const glm::vec3 position : tie.wrong)
        reject(driver.hit(tie.before, tie.before.position - position, tie.params));
    if (!tie.may_miss)
        reject(driver.fall(tie.before, tie.params));
    ParticleState off = first;
    off.position.y = moved(off.position.y, 1);
    if (std::abs(off.position.y) > 1e-30F) // tiny ones may be flushed
        reject(off);
    off = first;
    off.collide_time = moved(off.collide_time, -1);
    reject(off);
    off = first;
    off.direction = -off.direction;
    reject(off);
}

/// Texel edge k: a position at k, or at k +- 1/256 texel, and up to 2 ULP beside it.
float beside_edge(int k, int shift, int ulps) {
    const double ndc = (k + shift / 256.0) * 2.0 / size - 1.0;
    return moved(static_cast<float>(3.0 * ndc), ulps);
}

int between(Random& random, int low, int high) {
    return low + static_cast<int>(random.below(static_cast<std::uint32_t>(high - low + 1)));
}

} // namespace

TEST_CASE("ties: base texels at a texel's edge and corner") {
    Random random(1);
    Tally tally;
    for (int i = 0; i < ties_of_a_kind; ++i) {
        Constructed tie;
        const int column = between(random, 4, size - 4);
        const int row = between(random, 4, size - 4);
        const int column_shift = between(random, -1, 1);
        const int row_shift = between(random, -1, 1);
        tie.before.position = {beside_edge(column, column_shift, between(random, -2, 2)),
                               beside_edge(row, row_shift, between(random, -2, 2)), 0.0F};
        const glm::vec3 p = tie.before.position;
        // Each of the four base texels sees one of these, and no other does.
        const std::array<glm::vec3, 4> seen{p + glm::vec3(0.2F, 0.0F, 0.0F), p + glm::vec3(0.0F, 0.2F, 0.0F),
                                            p + glm::vec3(0.0F, 0.0F, 0.2F), p - glm::vec3(0.1F, 0.1F, 0.1F)};
        tie.store(column + 1, row + 1, seen[0]);
        tie.store(column - 2, row + 1, seen[1]);
        tie.store(column + 1, row - 2, seen[2]);
        tie.store(column - 2, row - 2, seen[3]);
        tie.store(column + 3, row, p + glm::vec3(0.0F, 0.05F, -0.05F)); // nearest, but out of sight
        tie.wrong.push_back(p + glm::vec3(0.0F, 0.05F, -0.05F));
        // Off the edge by 1/256 texel there is one answer.
        if (column_shift != 0 || row_shift != 0)
            for (int other = 0; other < 4; ++other) {
                const bool left = other % 2 == 1;
                const bool lower = other >= 2;
                if ((column_shift != 0 && left != (column_shift < 0)) || (row_shift != 0 && lower != (row_shift < 0)))
                    tie.wrong.push_back(seen[static_cast<std::size_t>(other)]);
            }
        judge(tie, random, tally);
    }
    CHECK(tally.more_than_one > 500);
    CHECK(tally.median_set_size() == 1);
    CHECK(tally.largest_set() == 4);
    CHECK(tally.rejected > 3 * ties_of_a_kind);
}

TEST_CASE("ties: neighbours as far as the collision range") {
    Random random(2);
    Tally tally;
    for (int i = 0; i < ties_of_a_kind; ++i) {
        Constructed tie;
        const float range = random.between(0.01F, 0.4F);
        tie.params.constants.collision_range = range;
        tie.before.position = {random.between(-0.5F, 0.5F), random.between(-0.5F, 0.5F), random.between(-0.5F, 0.5F)};
        const glm::vec3 p = tie.before.position;
        glm::dvec3 way{random.between(-1.0F, 1.0F), random.between(-1.0F, 1.0F), random.between(0.1F, 1.0F)};
        way *= double{range} / glm::length(way);
        glm::vec3 neighbour = glm::vec3(glm::dvec3(p) + way);
        neighbour.x = moved(neighbour.x, between(random, -1, 1));
        const auto base = base_texel(p, tie.params, named_profile("strict"));
        tie.store(base.x + 1, base.y, neighbour);
        const glm::dvec3 apart = glm::dvec3(p - neighbour);
        const double gap = (glm::length(apart) - range) / range;
        tie.may_miss = gap > -16.0 * 0x1p-23;
        if (gap > 16.0 * 0x1p-23)
            tie.wrong.push_back(neighbour);
        const glm::vec3 far = p - glm::vec3(way * 1.01);
        tie.store(base.x - 1, base.y, far);
        tie.wrong.push_back(far);
        judge(tie, random, tally);
    }
    CHECK(tally.more_than_one > 300);
    CHECK(tally.largest_set() == 2);
}

TEST_CASE("ties: equidistant neighbours") {
    Random random(3);
    Tally tally;
    for (int i = 0; i < ties_of_a_kind; ++i) {
        Constructed tie;
        // Dyadic, so that the distances are equal to the last bit before any ULP is added.
        const auto dyadic = [&](int range) { return static_cast<float>(between(random, -range, range)) * 0x1p-10F; };
        tie.before.position = {dyadic(400), dyadic(400), dyadic(400)};
        const glm::vec3 p = tie.before.position;
        const float a = dyadic(100) + 0x1p-4F;
        const float b = dyadic(100);
        const float c = dyadic(100);
        const auto base = base_texel(p, tie.params, named_profile("strict"));
        const int count = between(random, 2, 4);
        const glm::vec3 around[] = {{a, b, c}, {-b, a, c}, {c, -a, b}, {-b, -c, -a}};
        for (int n = 0; n < count; ++n) {
            glm::vec3 neighbour = p + around[n];
            neighbour.y = moved(neighbour.y, between(random, -1, 1));
            tie.store(base.x - 1 + n % 3, base.y + 1 - n / 3 * 2, neighbour);
        }
        const glm::vec3 farther = p - glm::vec3(a, b, c) * 1.001F;
        tie.store(base.x + 1, base.y, farther);
        if (a != b || b != c) // else it lies where the fourth neighbour does
            tie.wrong.push_back(farther);
        judge(tie, random, tally);
    }
    CHECK(tally.more_than_one > 1000);
    CHECK(tally.median_set_size() == 3); // of 2 to 4 that are equally near
    CHECK(tally.largest_set() == 4);
}

TEST_CASE("ties: a collide time that is a subnormal below 0") {
    Random random(4);
    Tally tally;
    for (int i = 0; i < 500; ++i) {
        Constructed tie;
        tie.before.position = {random.between(-0.5F, 0.5F), random.between(-0.5F, 0.5F), 0.0F};
        const bool subnormal = i % 2 == 0;
        tie.before.collide_time = -random.between(0.01F, 0.9F) * std::numeric_limits<float>::min();
        if (!subnormal)
            tie.before.collide_time = -std::numeric_limits<float>::min();
        tie.may_miss = subnormal;
        const auto base = base_texel(tie.before.position, tie.params, named_profile("strict"));
        tie.store(base.x, base.y + 1, tie.before.position + glm::vec3(0.1F, 0.2F, 0.1F));
        judge(tie, random, tally);
    }
    CHECK(tally.more_than_one == 250);
}

namespace {

/// Two particles and the texels round them.
struct Drawn {
    FrameParams params;
    Particles particles;
    KnownOperations known;
    Drawn() {
        params.width = params.height = size;
        params.switches.obstacles_in_cdt = ObstaclesInCdt::off;
    }
    void add(glm::vec3 position) {
        particles.resize(particles.size() + 1);
        particles.position.back() = position;
    }
    [[nodiscard]] LegalTexel texel(int x, int y) const {
        const std::size_t wanted[] = {static_cast<std::size_t>(y) * size + static_cast<std::size_t>(x)};
        return legal_texels({}, particles, particles, params, named_profile("strict"), known, wanted)[0];
    }
    [[nodiscard]] bool may_own(int x, int y, std::size_t particle) const {
        return texel(x, y).owner_of(glm::vec4(particles.position[particle], 1.0F)) != nullptr;
    }
    [[nodiscard]] bool may_be_empty(int x, int y) const { return texel(x, y).owner_of(glm::vec4(0.0F)) != nullptr; }
};

/// Clip x of a window position.
float clip_of(double window) { return static_cast<float>(window * 2.0 / size - 1.0); }

} // namespace

TEST_CASE("ties: points near a pixel's edge, where nothing of the driver's grid is known") {
    Random random(5);
    for (int i = 0; i < ties_of_a_kind; ++i) {
        Drawn drawn;
        const int column = between(random, 2, size - 2);
        const int row = between(random, 2, size - 2);
        const int shift = between(random, -20, 20);
        const float x = moved(clip_of(column + shift / 256.0), between(random, -1, 1));
        drawn.add({x, clip_of(row + 0.5), 0.25F});
        drawn.add({clip_of(column + 1.5), clip_of(row + 0.5), -0.5F});
        if (std::abs(shift) == 16)
            continue; // the grid's step, give or take 1 part in 10^5
        const bool surely_lower = shift < -16;
        const bool surely_upper = shift > 16;
        REQUIRE(drawn.may_own(column - 1, row, 0) == !surely_upper);
        REQUIRE(drawn.may_own(column, row, 0) == !surely_lower);
        REQUIRE(drawn.may_be_empty(column - 1, row) == !surely_lower);
        REQUIRE(drawn.may_be_empty(column, row) == !surely_upper);
        // Third outcomes: a particle from elsewhere, and two columns on.
        REQUIRE_FALSE(drawn.may_own(column - 1, row, 1));
        REQUIRE_FALSE(drawn.may_own(column + 1, row, 0));
        REQUIRE_FALSE(drawn.may_be_empty(column + 1, row));
        REQUIRE(drawn.texel(column, row).owner_of(glm::vec4(x, 0.0F, 0.0F, 1.0F)) == nullptr);
    }
}

TEST_CASE("ties: where the grid and the viewport are known, only a point on the edge itself may go either way") {
    Random random(7);
    for (int i = 0; i < ties_of_a_kind; ++i) {
        Drawn drawn;
        drawn.known.raster.point_window = drawn.known.raster.point_grid = true;
        const int column = between(random, 2, size - 2);
        const int row = between(random, 2, size - 2);
        const int shift = between(random, -3, 3);
        drawn.add({moved(clip_of(column + shift / 512.0), between(random, -1, 1)), clip_of(row + 0.5), 0.25F});
        const auto window = window_position({drawn.particles.position[0], 1.0F}, size, size, RasterRules{});
        const int place = snap_point(window.x, RasterRules{}) - (column * 256 - 128); // 1/256 pixel above the edge
        REQUIRE(drawn.may_own(column - 1, row, 0) == (place <= 0));
        REQUIRE(drawn.may_own(column, row, 0) == (place >= 0));
        drawn.known.raster.point_edges = true;
        REQUIRE(drawn.may_own(column - 1, row, 0) == (place <= 0));
        REQUIRE(drawn.may_own(column, row, 0) == (place > 0));
    }
}

TEST_CASE("ties: equal and adjacent depths") {
    Random random(6);
    int either = 0;
    for (int i = 0; i < ties_of_a_kind; ++i) {
        Drawn drawn;
        const int column = between(random, 2, size - 2);
        const int row = between(random, 2, size - 2);
        const float depth = random.between(-0.9F, 0.9F);
        const int step = between(random, -2, 2);
        const float other = i % 3 == 0 ? depth + static_cast<float>(step) * 0x1p-12F : moved(depth, step);
        drawn.add({clip_of(column + 0.3), clip_of(row + 0.5), depth});
        drawn.add({clip_of(column + 0.7), clip_of(row + 0.5), other});
        drawn.add({clip_of(column + 0.6), clip_of(row + 0.4), std::max(depth, other) + 0.05F}); // behind both
        const bool first = drawn.may_own(column, row, 0);
        const bool second = drawn.may_own(column, row, 1);
        REQUIRE((first || second));
        either += first && second;
        if (depth == other) {
            REQUIRE(first);
            REQUIRE_FALSE(second);
        } else if (i % 3 == 0) {
            REQUIRE(first == (depth < other));
            REQUIRE(second == (depth > other));
        } else {
            REQUIRE((first || depth > other));
            REQUIRE((second || depth < other));
        }
        REQUIRE_FALSE(drawn.may_own(column, row, 2));
        REQUIRE_FALSE(drawn.may_be_empty(column, row));
    }
    CHECK(either > 500);
}

} // namespace lockstep::test::tie_suite_test
