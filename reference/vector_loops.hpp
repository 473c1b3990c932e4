#pragma once
#include <array>
#include <cstddef>

#include <glm/vec3.hpp>

namespace lockstep {

/// What the fast passes need for GCC to run their loops on vectors. A vector lane rounds like a scalar, so the bits
/// stay.

/// Before a loop whose rounds are independent of each other; kept a loop, since an unrolled one is no longer seen.
#if defined(__GNUC__) && !defined(__clang__)
#define LOCKSTEP_VECTOR_LOOP _Pragma("GCC ivdep") _Pragma("GCC unroll 1")
#else
#define LOCKSTEP_VECTOR_LOOP
#endif

/// Before a function with such loops: compiled for any x86-64 and for those with AVX2 and FMA, picked when the program
/// is loaded (too early for sanitizers), with all it calls compiled into it.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__linux__) &&                           \
    !defined(__SANITIZE_ADDRESS__)
#define LOCKSTEP_VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default"), flatten))
#else
#define LOCKSTEP_VECTOR_CLONES
#endif

/// Particles that go through a stage together: few enough to stay in the nearest cache.
constexpr std::size_t block_size = 256;

/// Vectors of a block, one array a coordinate.
struct Columns {
    std::array<float, block_size> x, y, z;

    void load(const glm::vec3* vectors, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i)
            set(i, vectors[i]);
    }
    void store(std::size_t count, glm::vec3* vectors) const {
        for (std::size_t i = 0; i < count; ++i) {
            vectors[i].x = x[i];
            vectors[i].y = y[i];
            vectors[i].z = z[i];
        }
    }
    [[nodiscard]] glm::vec3 at(std::size_t i) const { return {x[i], y[i], z[i]}; }
    void set(std::size_t i, glm::vec3 v) {
        x[i] = v.x;
        y[i] = v.y;
        z[i] = v.z;
    }
};

} // namespace lockstep
