#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include <glm/mat4x4.hpp>

#include "reference/model/lights/host.hpp"
#include "reference/readings/mistake.hpp"

namespace lockstep::lights {

/// Mistakes for which other pixels are to be tried.
enum class WrongDrawing : std::uint8_t {
    none,
    // At the matrix's site, or at the place in clip space.
    transposed,
    upside_down,
    mirrored,
    // Where all that is drawn is taken for covered.
    whole_boxes,
    // Another matrix: the part of Change::handed_over.
    view_missing
};
inline constexpr std::size_t wrong_drawings = 6;
constexpr std::size_t index_of(WrongDrawing how) { return static_cast<std::size_t>(how); }

WrongDrawing wrong_drawing(std::span<const Mistake> made);
/// The matrix to clip space that is handed over.
glm::mat4 handed_matrix(const Host& host, WrongDrawing how);
/// What it comes to, with what is done at the sites.
glm::mat4 wrong_matrix(const Host& host, WrongDrawing how);

} // namespace lockstep::lights
