#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "reference/model/arithmetic_switch.hpp"
#include "reference/readings/exponential.hpp"
#include "reference/readings/lanes.hpp"
#include "reference/system/item_reads.hpp"
#include "reference/system/item_twin.hpp"
#include "reference/system/item_words.hpp"
#include "reference/vector_loops.hpp"

namespace lockstep {

/// An item of each lane, and how many there are.
struct LaneItems {
    IntLanes v{};
    std::size_t count = 0;
};

/// The places of the items in an image: side by side in one row, of one column of tiles.
struct LanePixel {
    LaneInt x;
    int first = 0, y = 0;
    [[nodiscard]] bool is_in(const PixelRect& box) const {
        return first + lane_count > box.x0 && first < box.x1 && y >= box.y0 && y < box.y1;
    }
};
inline Pixel first_of(const LanePixel& pixel) { return {pixel.first, pixel.y}; }

LOCKSTEP_INLINE IntLanes from(int first) { return IntLanes{0, 1, 2, 3, 4, 5, 6, 7} + first; }

/// Whether each is one more than the one before.
LOCKSTEP_INLINE bool are_side_by_side(const IntLanes& at) { return lanes::set_of(at == from(at[0])) == every_lane; }

inline LanePixel pixel_at(int width, const LaneItems& items) {
    const int first = items.v[0] % width;
    return {LaneInt(from(first)), first, items.v[0] / width};
}

LOCKSTEP_INLINE FloatLanes lane_floats(const SystemView& state, FieldId field, const LaneItems& items, int component) {
    const View& view = state[field.resource];
    const auto components = static_cast<std::int32_t>(view.fields()[field.field].components);
    const std::byte* from_first = view.columns[field.field];
    FloatLanes found{};
    const IntLanes& at = items.v;
    if (components == 1 && are_side_by_side(at)) {
        std::memcpy(&found, from_first + static_cast<std::size_t>(at[0]) * sizeof(float), sizeof found);
        return found;
    }
    for (int lane = 0; lane < lane_count; ++lane) {
        float one = 0.0F;
        std::memcpy(&one, from_first + static_cast<std::size_t>(at[lane] * components + component) * sizeof one,
                    sizeof one);
        found[lane] = one;
    }
    return found;
}

LOCKSTEP_INLINE FloatLanes raw_real(const SystemView& state, FieldId field, const LaneItems& items, int component = 0) {
    return lane_floats(state, field, items, component);
}
template <class F> LaneReal<F> item_real(Lanes<F>& r, At at, const SystemView& state, FieldId field,
                                         const LaneItems& items, int component = 0) {
    return r.read(at, lane_floats(state, field, items, component));
}
template <class F>
Vec3<LaneReal<F>> item_vec3(Lanes<F>& r, At at, const SystemView& state, FieldId field, const LaneItems& items) {
    return {item_real(r, at, state, field, items, 0), item_real(r, at, state, field, items, 1),
            item_real(r, at, state, field, items, 2)};
}
inline LaneInt item_int(const SystemView& state, FieldId field, const LaneItems& items, int component = 0) {
    return lanes::bits(lane_floats(state, field, items, component));
}
/// Of words below 2^31.
template <class F>
LaneReal<F> whole_real(Lanes<F>& r, const SystemView& state, FieldId field, const LaneItems& items, int component = 0) {
    return r.real(item_int(state, field, items, component));
}

inline LaneInt clamped(const LaneInt& i, int low, int high) { return i.clamped(low, high); }
inline LaneMask is_among(const LaneInt& i, int size) { return LaneMask((i.v >= 0) & (i.v < size)); }
inline LaneItems item_of(const LaneInt& x, int y, int width) { return {x.v + y * width, lane_count}; }
inline LaneItems item_of(const LaneInt& x, const LaneInt& y, int width) { return {x.v + y.v * width, lane_count}; }

/// The words of an item of each lane.
template <class F> class ItemWords<Lanes<F>> {
  public:
    static constexpr std::size_t most = 12;

    void add(const LaneReal<F>& number) { words_[size_++] = lanes::bits(number.v); }
    void add(const LaneInt& number) { words_[size_++] = number.v; }
    void add(std::uint32_t bits) { words_[size_++] = lanes::all(static_cast<std::int32_t>(bits)); }

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] std::uint32_t word(std::size_t w, int lane) const {
        return static_cast<std::uint32_t>(words_[w][lane]);
    }
    [[nodiscard]] const IntLanes& of_lanes(std::size_t w) const { return words_[w]; }

  private:
    std::array<IntLanes, most> words_; // NOLINT: as many as were added
    std::size_t size_ = 0;
};

/// e^x of x from -87 to 0.
template <class F> LaneReal<F> exponential_of_lanes(const LaneReal<F>& x) {
    return exponential(
        x, [](const LaneReal<F>& v) { return Lanes<F>::floor(v); },
        [](const LaneReal<F>& p, const LaneReal<F>& j) {
            const IntLanes n = __builtin_convertvector(j.v, IntLanes), half = n / 2;
            const auto two_to = [](const IntLanes& k) { return LaneReal<F>(lanes::floats((k + 127) << 23)); };
            return p * two_to(half) * two_to(n - half);
        });
}

/// portable_exponential (readings/exponential.hpp), lane by lane.
template <class F> LaneReal<F> portable_exponential(Lanes<F>& /*r*/, At, const LaneReal<F>& x) {
    return choose(x >= LaneReal<F>(least_exponent), exponential_of_lanes(x), LaneReal<F>(0.0F));
}

// GLSL's own functions, lane by lane: as those of one item give them.
template <class F> LaneReal<F> built_in_exponential(Lanes<F>& /*r*/, At, const LaneReal<F>& x) {
    const IntLanes is_inside = (x.v >= least_exponent) & (x.v <= 0.0F);
    FloatLanes found = exponential_of_lanes(LaneReal<PlainLanes>(is_inside ? x.v : lanes::all(0.0F))).v;
    for (unsigned others = ~lanes::set_of(is_inside) & every_lane; others != 0; others &= others - 1)
        found[std::countr_zero(others)] = exponential_value(x.v[std::countr_zero(others)]);
    return found;
}
template <class F> LaneReal<F> built_in_power(Lanes<F>& /*r*/, At at, const LaneReal<F>& x, int n) {
    Values<Strict> one{Strict{}};
    return lanes::each(x.v, [&](float v) { return built_in_power<Values<Strict>, float>(one, at, v, n); });
}

/// What a twin gave, as words.
template <class F> const ItemWords<Lanes<F>>& lane_words(const ItemWords<Lanes<F>>& words) { return words; }
template <class F, class State> ItemWords<Lanes<F>> lane_words(const State& state) {
    ItemWords<Lanes<F>> words;
    item_twin::for_each_number(state, [&](const auto& x) { words.add(x); });
    return words;
}

/// Makes as many items as there are lanes, or less: in turns, of those that go one way at every decision.
template <class F, class Twin> void make_batch(const Twin& twin, F arithmetic, const FastRun& run,
                                               std::span<const item_twin::WordColumn> columns, const LaneItems& items) {
    const bool are_neighbours = are_side_by_side(items.v);
    unsigned waiting = (1U << items.count) - 1;
    while (waiting != 0) {
        Lanes<F> reading(arithmetic, waiting);
        const ItemWords<Lanes<F>> words = lane_words<F>(twin(reading, run.in, items));
        if (reading.active() == 0)
            break;
        for (std::size_t w = 0; w < words.size(); ++w) {
            if (are_neighbours && reading.active() == every_lane && columns[w].stride == sizeof(std::uint32_t)) {
                std::memcpy(columns[w].first + static_cast<std::size_t>(items.v[0]) * sizeof(std::uint32_t),
                            &words.of_lanes(w), sizeof(IntLanes));
                continue;
            }
            for (int lane = 0; lane < static_cast<int>(items.count); ++lane)
                if ((reading.active() >> lane & 1U) != 0) {
                    const std::uint32_t word = words.word(w, lane);
                    std::memcpy(columns[w].first + static_cast<std::size_t>(items.v[lane]) * columns[w].stride, &word,
                                sizeof word);
                }
        }
        waiting &= ~reading.active();
    }
    for (int lane = 0; lane < static_cast<int>(items.count); ++lane)
        if ((waiting >> lane & 1U) != 0)
            run.left.push_back(static_cast<std::size_t>(items.v[lane]));
}

/// Makes items of an image by lanes, those of a tile's row side by side. To be compiled into a function that is
/// compiled for vectors (vector_loops.hpp).
template <class F, class Twin> void make_lanes(const Twin& twin, F arithmetic, const FastRun& run) {
    const std::vector<item_twin::WordColumn> columns = item_twin::word_columns(run.after);
    const auto row = static_cast<std::size_t>(twin.host->settings().width);
    const std::size_t last = run.last;
    std::size_t first = run.first;
    while (first < last) {
        const std::size_t x = first % row, tile = x % lane_count;
        const std::size_t count = std::min({lane_count - tile, row - x, last - first});
        const IntLanes behind = from(static_cast<std::int32_t>(first));
        const auto most = static_cast<std::int32_t>(first + count - 1);
        make_batch(twin, arithmetic, run, columns, LaneItems{behind > most ? lanes::all(most) : behind, count});
        first += count;
    }
}

/// The same of items wherever they are.
template <class F, class Twin>
void make_items(const Twin& twin, F arithmetic, const FastRun& run, std::span<const std::size_t> items) {
    const std::vector<item_twin::WordColumn> columns = item_twin::word_columns(run.after);
    for (std::size_t first = 0; first < items.size(); first += lane_count) {
        LaneItems batch;
        batch.count = std::min<std::size_t>(lane_count, items.size() - first);
        for (std::size_t lane = 0; lane < lane_count; ++lane)
            batch.v[static_cast<int>(lane)] = static_cast<std::int32_t>(items[first + std::min(lane, batch.count - 1)]);
        make_batch(twin, arithmetic, run, columns, batch);
    }
}

/// Makes a twin's items by lanes with `make(twin, arithmetic, run)`, but for a driver whose roots come of tables, or
/// whose normalize divides: false.
template <class Twin, class Make> bool fast_by_lanes(const Twin& twin, const FastRun& run, const Make& make) {
    if (run.arithmetic == ArithmeticSwitch::exact)
        make(twin, PortableLanes{}, run);
    else if (run.profile.roots == nullptr && !run.profile.normalize_divides)
        make(twin, PlainLanes{run.profile.dot, run.profile.length_order(), run.profile.normalize_order()}, run);
    else
        return false;
    return true;
}

/// `make(twin, arithmetic, run, items)` of a twin, compiled for vectors.
#define LOCKSTEP_MAKE_ITEMS(Twin)                                                                                      \
    LOCKSTEP_VECTOR_CLONES void make(const Twin& twin, PlainLanes fp, const FastRun& run,                              \
                                     std::span<const std::size_t> items) {                                             \
        make_items(twin, fp, run, items);                                                                              \
    }                                                                                                                  \
    LOCKSTEP_VECTOR_CLONES void make(const Twin& twin, PortableLanes fp, const FastRun& run,                           \
                                     std::span<const std::size_t> items) {                                             \
        make_items(twin, fp, run, items);                                                                              \
    }

/// `make(twin, arithmetic, run)` of a twin, compiled for vectors.
#define LOCKSTEP_MAKE_LANES(Twin)                                                                                      \
    LOCKSTEP_VECTOR_CLONES void make(const Twin& twin, PlainLanes fp, const FastRun& run) {                            \
        make_lanes(twin, fp, run);                                                                                     \
    }                                                                                                                  \
    LOCKSTEP_VECTOR_CLONES void make(const Twin& twin, PortableLanes fp, const FastRun& run) {                         \
        make_lanes(twin, fp, run);                                                                                     \
    }

} // namespace lockstep
