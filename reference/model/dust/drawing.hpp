#pragma once
#include <array>
#include <cstdint>
#include <span>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "reference/model/dust/host.hpp"
#include "reference/model/schema.hpp"

namespace lockstep::dust {

/// What drawing adds to the state: the corners of every grain's quad or cube, as the vertex stage puts them out.
const Schema& drawn_schema();

inline constexpr std::uint8_t corner_buffer = 2;

/// A grain's shape: corners of a side of 1 around 0, and its triangles.
std::span<const glm::vec3> corners(Mesh mesh);
std::span<const std::uint32_t> triangles(Mesh mesh);

/// What the host hands the vertex stage. Made in double, rounded once.
struct Drawing {
    glm::vec3 right{1.0F, 0.0F, 0.0F}, up{0.0F, 1.0F, 0.0F}, back{0.0F, 0.0F, 1.0F}; ///< a cube's: the world's axes
    glm::mat4 view_projection{1.0F};
};
Drawing drawing(const Settings& settings, float aspect);

/// Whether anything is drawn at all: with draw_bounds=box not where the camera sees nothing of a box around the origin.
bool is_drawn(const Settings& settings, const Drawing& drawing);

} // namespace lockstep::dust
