#pragma once
#include <cmath>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace lockstep {

/// What an arithmetic (arithmetic.hpp) computes with: floats, unless it says otherwise, as legal_number.hpp does.
template <class A> struct NumbersOf {
    using Real = float;
    using Bool = bool;
    using Vec2 = glm::vec2;
    using Vec3 = glm::vec3;
    using Vec4 = glm::vec4;
};
template <class A>
requires requires { typename A::Real; }
struct NumbersOf<A> {
    using Real = typename A::Real;
    using Bool = typename A::Bool;
    using Vec2 = typename A::Vec2;
    using Vec3 = typename A::Vec3;
    using Vec4 = typename A::Vec4;
};

/// Both are evaluated.
template <class T> T choose(bool condition, const T& yes, const T& no) { return condition ? yes : no; }

/// What x is where `holds`, which says that it is at most `most`, holds.
inline float where(bool, float x, float) { return x; }

inline float abs(float x) { return std::abs(x); }

} // namespace lockstep
