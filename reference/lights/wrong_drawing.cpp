#include "reference/lights/wrong_drawing.hpp"

#include <glm/matrix.hpp>

#include "reference/lights/sites.hpp"

namespace lockstep::lights {
namespace {

WrongDrawing wrong_drawing(const Mistake& made) {
    if (made.change == Change::handed_over)
        return static_cast<WrongDrawing>(made.part);
    if (made.site == site::projection.id && made.change == Change::transposed)
        return WrongDrawing::transposed;
    if (made.site == site::clip.id && made.change == Change::negated && made.part == 0)
        return WrongDrawing::mirrored;
    if (made.site == site::clip.id && made.change == Change::negated && made.part == 1)
        return WrongDrawing::upside_down;
    if (made.site == site::is_front.id && made.change == Change::always)
        return WrongDrawing::whole_boxes;
    return WrongDrawing::none;
}

glm::mat4 with_negated_row(glm::mat4 m, int row) {
    for (int column = 0; column < 4; ++column)
        m[column][row] = -m[column][row];
    return m;
}

} // namespace

WrongDrawing wrong_drawing(std::span<const Mistake> made) {
    for (const Mistake& mistake : made)
        if (const WrongDrawing how = wrong_drawing(mistake); how != WrongDrawing::none)
            return how;
    return WrongDrawing::none;
}

glm::mat4 handed_matrix(const Host& host, WrongDrawing how) {
    return how == WrongDrawing::view_missing ? host.projection() : host.view_projection();
}

glm::mat4 wrong_matrix(const Host& host, WrongDrawing how) {
    const glm::mat4 handed = handed_matrix(host, how);
    switch (how) {
    case WrongDrawing::transposed:
        return glm::transpose(handed);
    case WrongDrawing::mirrored:
        return with_negated_row(handed, 0);
    case WrongDrawing::upside_down:
        return with_negated_row(handed, 1);
    default:
        return handed;
    }
}

} // namespace lockstep::lights
