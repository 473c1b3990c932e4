#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "reference/collision/collision_pass_fast.hpp"
#include "reference/collision/step_stage.hpp"
#include "reference/collision/stored_positions.hpp"
#include "reference/collision/texel_lookup.hpp"
#include "reference/vector_loops.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Radii the search is compiled for; others take the obvious way.
constexpr int widest_radius = 4;

/// The texels round a base texel, rows padded to a multiple of four. The centre and the padding do not count.
template <int radius> struct Neighbourhood {
    static constexpr int rows = 2 * radius + 1;
    static constexpr int lanes = (rows + 3) / 4 * 4;
    static constexpr int size = rows * lanes;

    /// Added to a squared distance: infinite where the texel does not count, else 0.
    alignas(32) static constexpr std::array<float, size> aside = [] {
        std::array<float, size> a{};
        for (int i = 0; i < size; ++i)
            a[i] = i % lanes < rows && i != radius * lanes + radius ? 0.0F : infinity;
        return a;
    }();
};

/// The largest square whose root lies within the collision range and below the listing's first best distance;
/// negative where there is none. Rounded roots never decrease, so halving finds it, in the order of the bits.
template <class A> float largest_square(A fp, float range) {
    const auto within = [&](float square) {
        const float length = fp.sqrt(square);
        return range > length && length < 100000.0F;
    };
    if (!within(0.0F))
        return -1.0F;
    std::uint32_t in = 0, out = std::bit_cast<std::uint32_t>(infinity);
    while (out - in > 1) {
        const std::uint32_t middle = in + (out - in) / 2;
        (within(std::bit_cast<float>(middle)) ? in : out) = middle;
    }
    return std::bit_cast<float>(in);
}

struct Update {
    const Particles& before;
    const StoredPositions& stored;
    const FrameParams& params;
    Particles& after;
};

/// The index of the base texel for every particle of the block that searches, -1 for the others.
template <class A> void search_texels(A fp, const Update& u, const Columns& position, std::size_t first,
                                      std::size_t count, std::int32_t* texel) {
    const glm::mat4 proj_view = u.params.collision_proj_view;
    const TexelLookup lookup(fp, u.params);
    const auto stride = static_cast<std::int32_t>(u.stored.stride);
    const auto origin = static_cast<std::int32_t>(u.stored.origin);
    const float* collide_time = &u.before.collide_time[first];
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t i = 0; i < count; ++i) {
        const auto base = lookup(fp.transform(proj_view, position.at(i)));
        const bool searches = base.inside & (fp.flush(collide_time[i]) < 0.0F);
        texel[i] = searches ? origin + base.y * stride + base.x : -1;
    }
}

/// Lines 26 to 30 for every particle of the block.
template <class A>
void integrate(A fp, const Update& u, const Columns& position, std::size_t first, std::size_t count) {
    const float tick = u.params.constants.tick;
    const glm::vec3 pull = fp.scale(u.params.constants.gravity, tick);
    const float* speed = &u.before.speed[first];
    const float* collide_time = &u.before.collide_time[first];
    float* new_speed = &u.after.speed[first];
    float* new_collide_time = &u.after.collide_time[first];
    Columns direction, new_direction, new_position;
    direction.load(&u.before.direction[first], count);
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 temp = fp.flush(fp.scale(fp.flush(direction.at(i)), fp.flush(speed[i])) + pull);
        const glm::vec3 along = fp.normalize(temp);
        const float fast = fp.length(temp);
        new_direction.set(i, along);
        new_position.set(i, fp.flush(fp.flush(position.at(i)) + fp.scale(fp.scale(along, fast), tick)));
        new_speed[i] = fast;
        new_collide_time[i] = fp.flush(fp.flush(collide_time[i]) - tick);
    }
    new_direction.store(count, &u.after.direction[first]);
    new_position.store(count, &u.after.position[first]);
}

/// Squared distances from `self` to the neighbourhood that starts at texel `corner`; infinite or NaN where a texel does
/// not count.
template <int radius, class A>
void square_distances(A fp, const StoredPositions& stored, glm::vec3 self, std::ptrdiff_t corner, float* squared) {
    using N = Neighbourhood<radius>;
    for (int row = 0; row < N::rows; ++row) {
        const float* x = stored.x.data() + corner + row * stored.stride;
        const float* y = stored.y.data() + corner + row * stored.stride;
        const float* z = stored.z.data() + corner + row * stored.stride;
        const float* aside = N::aside.data() + row * N::lanes;
        LOCKSTEP_VECTOR_LOOP
        for (int lane = 0; lane < N::lanes; ++lane) {
            const glm::vec3 apart = fp.flush(self - fp.flush(glm::vec3{x[lane], y[lane], z[lane]}));
            squared[row * N::lanes + lane] = fp.dot(apart, apart) + aside[lane];
        }
    }
}

/// The least of a neighbourhood's values, NaN passed over: column by column, then the columns four by four.
template <class N, class T> T least_of(const T* values, T most) {
    alignas(32) std::array<T, N::lanes> columns;
    columns.fill(most);
    for (int row = 0; row < N::rows; ++row, values += N::lanes) {
        LOCKSTEP_VECTOR_LOOP
        for (int lane = 0; lane < N::lanes; ++lane) {
            const T value = values[lane], so_far = columns[lane];
            columns[lane] = value < so_far ? value : so_far;
        }
    }
    for (int four = 4; four < N::lanes; four += 4)
        for (int lane = 0; lane < 4; ++lane)
            columns[lane] = std::min(columns[lane], columns[four + lane]);
    return std::min(std::min(columns[0], columns[1]), std::min(columns[2], columns[3]));
}

/// The first of the squares whose root rounds to the root of the least: equal distances, of which the first wins.
template <class N, class A> int first_nearest(A fp, const float* squared, float least) {
    const float close = least * (1.0F + 0x1p-21F); // squares of one root lie within 2^-22 of each other
    alignas(32) std::array<std::int32_t, N::size> index;
    LOCKSTEP_VECTOR_LOOP
    for (int i = 0; i < N::size; ++i)
        index[i] = squared[i] <= close ? i : N::size;
    int first = least_of<N, std::int32_t>(index.data(), N::size);
    while (squared[first] != least && !(squared[first] <= close && fp.sqrt(squared[first]) == fp.sqrt(least)))
        ++first;
    return first;
}

/// The particles of a block that collide, and their own position minus the nearest one.
struct Hits {
    std::size_t count = 0;
    std::array<std::uint32_t, block_size> particle;
    Columns away;

    void add(std::size_t i, glm::vec3 v) {
        particle[count] = static_cast<std::uint32_t>(i);
        away.set(count++, v);
    }
};

/// Lines 5 to 19 for every particle of the block that searches. `within`: the largest square that is a hit.
template <int radius, class A> void search(A fp, const Update& u, float within, const Columns& position,
                                           std::size_t count, const std::int32_t* texel, Hits& hits) {
    using N = Neighbourhood<radius>;
    const StoredPositions& stored = u.stored;
    const bool from_texel = u.params.switches.self_position == SelfPosition::texel;
    const bool skip_zero = u.params.switches.zero_distance == ZeroDistance::skip;
    alignas(32) std::array<float, N::size> squared;
    for (std::size_t i = 0; i < count; ++i) {
        if (texel[i] < 0)
            continue;
        const glm::vec3 self = fp.flush(from_texel ? stored.at(texel[i]) : position.at(i));
        const std::ptrdiff_t corner = texel[i] - radius * (stored.stride + 1);
        square_distances<radius>(fp, stored, self, corner, squared.data());
        float least = least_of<N>(squared.data(), infinity);
        if (least == 0.0F && skip_zero) {
            std::replace(squared.begin(), squared.end(), 0.0F, infinity);
            least = least_of<N>(squared.data(), infinity);
        }
        if (!(least <= within))
            continue;
        const int nearest = first_nearest<N>(fp, squared.data(), least);
        const std::ptrdiff_t index = corner + nearest / N::lanes * stored.stride + nearest % N::lanes;
        hits.add(i, fp.flush(self - fp.flush(stored.at(index))));
    }
}

/// Lines 21 to 24 for every hit of the block.
template <class A> void collide(A fp, const Update& u, const Columns& position, std::size_t first, const Hits& hits) {
    const Constants& constants = u.params.constants;
    const Switches& switches = u.params.switches;
    Columns direction;
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t i = 0; i < hits.count; ++i)
        direction.set(i, fp.normalize(hits.away.at(i)));
    for (std::size_t i = 0; i < hits.count; ++i) {
        const std::size_t p = first + hits.particle[i];
        const float speed = fp.flush(fp.flush(u.before.speed[p]) * switches.speed_factor);
        glm::vec3 step = fp.scale(direction.at(i), speed);
        if (switches.collision_step == CollisionStep::tick)
            step = fp.scale(step, constants.tick);
        u.after.position[p] = fp.flush(fp.flush(position.at(hits.particle[i])) + step);
        u.after.direction[p] = direction.at(i);
        u.after.speed[p] = speed;
        u.after.collide_time[p] = constants.collision_time;
    }
}

template <class A, int radius>
LOCKSTEP_VECTOR_CLONES void update_block(A fp, const Update& u, float within, std::size_t first, std::size_t count) {
    std::array<std::int32_t, block_size> texel;
    Columns position;
    Hits hits;
    position.load(&u.before.position[first], count);
    search_texels(fp, u, position, first, count, texel.data());
    integrate(fp, u, position, first, count);
    search<radius>(fp, u, within, position, count, texel.data(), hits);
    collide(fp, u, position, first, hits);
}

template <class A> void update(A fp, const Update& u, const Profile& profile) {
    constexpr std::array<void (*)(A, const Update&, float, std::size_t, std::size_t), widest_radius> blocks{
        update_block<A, 1>, update_block<A, 2>, update_block<A, 3>, update_block<A, 4>};
    const auto block = blocks[u.params.constants.texel_collide_range - 1];
    const auto count = static_cast<std::ptrdiff_t>(u.before.size());
#pragma omp parallel
    {
        const FlushSubnormals guard = flush_in_step(u.params.switches, profile);
        const float within = largest_square(fp, u.params.constants.collision_range);
#pragma omp for schedule(dynamic, 16)
        for (std::ptrdiff_t first = 0; first < count; first += block_size) {
            const auto start = static_cast<std::size_t>(first);
            block(fp, u, within, start, std::min(block_size, u.before.size() - start));
        }
    }
}

} // namespace

void update_particles_fast(const Particles& before, const CollisionImage& cdt, const FrameParams& params,
                           const Profile& profile, Particles& after) {
    const int radius = params.constants.texel_collide_range;
    const bool exact = params.switches.arithmetic == ArithmeticSwitch::exact;
    const bool vector = params.switches.velocity == Velocity::vector;
    const bool stands = params.switches.not_searching == NotSearching::stands;
    if (vector || stands || radius < 1 || radius > widest_radius || // the driver's roots may not be monotonic
        (!exact && (profile.roots != nullptr || !has_fast_orders(profile))))
        return update_particles(before, cdt, params, profile, after);
    assert(&before != &after && cdt.width == params.width && cdt.height == params.height);
    after.resize(before.size());
    const StoredPositions stored = stored_positions(cdt, params, radius, 3);
    with_arithmetic(profile, params.switches.arithmetic, [&]<class A>(A fp) {
        if constexpr (!std::is_same_v<A, DriverRoots> && !std::is_same_v<A, OwnOrders>)
            update(fp, {before, stored, params, after}, profile);
    });
}

} // namespace lockstep
