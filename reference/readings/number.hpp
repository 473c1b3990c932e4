#pragma once
#include <type_traits>

#include <glm/vec3.hpp>

#include "reference/portable.hpp"
#include "reference/readings/vector.hpp"

namespace lockstep {

/// A float whose + - * treat tiny values as `A` does, so that no twin says flush.
template <class A> struct FlushingNumber {
    float value = 0.0F;

    FlushingNumber() = default;
    FlushingNumber(float x) : value(x) {} // NOLINT: a float is one, as it stands
    explicit operator float() const { return value; }
    friend FlushingNumber operator+(FlushingNumber a, FlushingNumber b) { return A::flush(a.value + b.value); }
    friend FlushingNumber operator-(FlushingNumber a, FlushingNumber b) { return A::flush(a.value - b.value); }
    friend FlushingNumber operator*(FlushingNumber a, FlushingNumber b) { return A::multiply(a.value, b.value); }
    friend FlushingNumber operator-(FlushingNumber a) { return A::flush(-a.value); }
    friend auto operator<=>(FlushingNumber a, FlushingNumber b) { return a.value <=> b.value; }
    friend bool operator==(FlushingNumber a, FlushingNumber b) { return a.value == b.value; }
};

/// Whether an arithmetic has rules of its own for tiny values.
template <class A> constexpr bool flushes = std::is_base_of_v<Portable, A>;

/// The plain number of an arithmetic: a float, where the language's own + - * are the arithmetic's.
template <class A> using NumberOf = std::conditional_t<flushes<A>, FlushingNumber<A>, float>;

template <class T> glm::vec3 floats(const Vec3<T>& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

} // namespace lockstep
