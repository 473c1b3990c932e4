#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reference/model/schema.hpp"
#include "reference/model/state_view.hpp"
#include "reference/model/value.hpp"

namespace lockstep {

/// One differing value. Equality is of bits; two NaNs are equal (spec, "The listing"). There is no tolerance.
struct Difference {
    FieldId field;
    std::size_t index = 0; ///< item; texels are counted row by row from the bottom
    int component = 0;     ///< x, y, z, w
    Value reference;
    Value gpu;
    std::int64_t ulp = 0; ///< 0 only for -0 against +0; INT64_MAX for NaN against a number; of integers how far apart
};

struct FieldCount {
    std::uint64_t compared = 0;  ///< values
    std::uint64_t differing = 0; ///< values whose bits differ
    std::uint64_t nan = 0;       ///< values that are NaN on the GPU
};

/// Of one buffer or image.
struct ResourceCount {
    Extent extent = {};          ///< the reference's, the last that was compared
    std::uint64_t differing = 0; ///< items; those that one side alone has are among them
    std::vector<FieldCount> fields = {};
};

/// The comparison of one frame, or the sum over several.
struct Comparison {
    std::vector<ResourceCount> resources; ///< as far as they were compared, in the schema's order
    std::vector<Difference> worst;        ///< at most worst_kept, the largest ULP first, then field and index

    static constexpr std::size_t worst_kept = 8;

    [[nodiscard]] bool agree() const;
    [[nodiscard]] std::uint64_t compared() const;                       ///< values
    [[nodiscard]] std::uint64_t compared(std::uint8_t resource) const;  ///< values
    [[nodiscard]] std::uint64_t differing(std::uint8_t resource) const; ///< items
    [[nodiscard]] FieldCount operator[](FieldId field) const;
    void add(const Comparison& other);
};

/// Compares every value of two buffers or images of one schema. Of images both have the same size. The same answer for
/// any thread count.
Comparison compare(const View& reference, const View& gpu);

/// What compare() finds of two that are this state to the last bit, without NaN.
Comparison agreement(const View& state);

/// The indices of items that are not bit-equal, in order; of buffers of different sizes those that both have.
std::vector<std::size_t> differing_items(const View& reference, const View& gpu);

/// Of states held by types that have a view.
template <class State> Comparison compare(const State& reference, const State& gpu) requires requires {
    view(reference);
}
{ return compare(view(reference), view(gpu)); }
template <class State>
std::vector<std::size_t> differing_items(const State& reference, const State& gpu) requires requires {
    view(reference);
}
{ return differing_items(view(reference), view(gpu)); }

} // namespace lockstep
