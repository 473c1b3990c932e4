#pragma once
#include <tuple>

#include <glm/vec3.hpp>

namespace lockstep {

/// Vectors of any reading's numbers. `fields()` is what a reading knows of a struct.
template <class T> struct Vec2 {
    T x{}, y{};
    auto fields() { return std::tie(x, y); }
    auto fields() const { return std::tie(x, y); }
    friend Vec2 operator+(const Vec2& a, const Vec2& b) { return {a.x + b.x, a.y + b.y}; }
    friend Vec2 operator-(const Vec2& a, const Vec2& b) { return {a.x - b.x, a.y - b.y}; }
    friend Vec2 operator*(const Vec2& a, const Vec2& b) { return {a.x * b.x, a.y * b.y}; }
    template <class S> friend Vec2 operator+(const Vec2& v, const S& s) { return {v.x + s, v.y + s}; }
    template <class S> friend Vec2 operator*(const Vec2& v, const S& s) { return {v.x * s, v.y * s}; }
};

template <class T> struct Vec3 {
    T x{}, y{}, z{};
    auto fields() { return std::tie(x, y, z); }
    auto fields() const { return std::tie(x, y, z); }
    friend Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vec3 operator*(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
    friend Vec3 operator-(const Vec3& v) { return {-v.x, -v.y, -v.z}; }
    template <class S> friend Vec3 operator*(const Vec3& v, const S& s) { return {v.x * s, v.y * s, v.z * s}; }
};

template <class T> struct Vec4 {
    T x{}, y{}, z{}, w{};
    auto fields() { return std::tie(x, y, z, w); }
    auto fields() const { return std::tie(x, y, z, w); }
};

} // namespace lockstep
