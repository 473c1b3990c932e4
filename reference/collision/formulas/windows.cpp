#include "reference/collision/formulas/words.hpp"

#include <cstdlib>
#include <deque>
#include <string_view>

namespace lockstep::formulas {
namespace {

/// Of a texel that is looked at: which one, counted from the base texel.
struct Offset {
    int x, y;
};
Offset offset(Floats skipped) { return {static_cast<int>(skipped[1]), static_cast<int>(skipped[3])}; }
template <class Skip> void skip_too(Floats answer, const Skip& skip) {
    const Offset o = offset(answer);
    if (skip(o.x, o.y))
        answer[0] = 1.0F;
}

} // namespace

void add_windows(std::vector<FormulaMistake>& all) {
    all.push_back({"cross_searched", "only the base texel's row and column are searched",
                   skipped([](Floats v, Run) { skip_too(v, [](int x, int y) { return x != 0 && y != 0; }); })});
    all.push_back({"own_row_searched", "only the base texel's row is searched",
                   skipped([](Floats v, Run) { skip_too(v, [](int, int y) { return y != 0; }); })});
    all.push_back({"own_column_searched", "only the base texel's column is searched",
                   skipped([](Floats v, Run) { skip_too(v, [](int x, int) { return x != 0; }); })});
    all.push_back({"diagonals_searched", "only the base texel's diagonals are searched", skipped([](Floats v, Run) {
                       skip_too(v, [](int x, int y) { return std::abs(x) != std::abs(y); });
                   })});
    all.push_back({"disc_searched", "a disc of texels is searched, not a square", skipped([](Floats v, Run run) {
                       const int r = reach(run);
                       skip_too(v, [&](int x, int y) { return x * x + y * y > r * r; });
                   })});
    all.push_back({"diamond_searched", "texels with |tx| + |ty| <= range are searched", skipped([](Floats v, Run run) {
                       const int r = reach(run);
                       skip_too(v, [&](int x, int y) { return std::abs(x) + std::abs(y) > r; });
                   })});
    all.push_back(
        {"ring_searched", "only the outermost texels of the window are searched", skipped([](Floats v, Run run) {
             const int r = reach(run);
             skip_too(v, [&](int x, int y) { return std::max(std::abs(x), std::abs(y)) < r; });
         })});
    all.push_back({"checkerboard_searched", "of the image's texels only every other is read, as on a checkerboard",
                   fetch([](Floats v, Run) {
                       if ((static_cast<int>(v[0]) + static_cast<int>(v[1])) % 2 != 0)
                           leave_out(v);
                   })});
    all.push_back({"odd_checkerboard_searched", "only texels with an odd x + y are read", fetch([](Floats v, Run) {
                       if ((static_cast<int>(v[0]) + static_cast<int>(v[1])) % 2 == 0)
                           leave_out(v);
                   })});
    all.push_back({"every_other_offset_searched", "only texels with an even tx + ty are searched",
                   skipped([](Floats v, Run) { skip_too(v, [](int x, int y) { return (x + y) % 2 != 0; }); })});
    all.push_back(
        {"half_stencil_searched", "only texels after the base texel in reading order are searched",
         skipped([](Floats v, Run) { skip_too(v, [](int x, int y) { return y < 0 || (y == 0 && x < 0); }); })});
    all.push_back(
        {"earlier_half_stencil_searched", "only texels before the base texel in reading order are searched",
         skipped([](Floats v, Run) { skip_too(v, [](int x, int y) { return y > 0 || (y == 0 && x > 0); }); })});
    all.push_back({"lower_triangle_searched", "only texels with tx <= ty are searched",
                   skipped([](Floats v, Run) { skip_too(v, [](int x, int y) { return x > y; }); })});
    all.push_back({"upper_triangle_searched", "only texels with tx >= ty are searched",
                   skipped([](Floats v, Run) { skip_too(v, [](int x, int y) { return x < y; }); })});
    all.push_back({"eight_texels_searched", "only the window's corners and the middles of its sides are searched",
                   skipped([](Floats v, Run run) {
                       const int r = std::max(reach(run), 1);
                       skip_too(v, [&](int x, int y) { return x % r != 0 || y % r != 0; });
                   })});
    all.push_back({"next_texel_skipped_for_own", "the texel on the right is skipped, and the base texel searched",
                   skipped([](Floats v, Run) {
                       const Offset o = offset(v);
                       v[0] = o.x == 1 && o.y == 0 ? 1.0F : 0.0F;
                   })});
    all.push_back({"texel_before_skipped_for_own", "the texel on the left is skipped, and the base texel searched",
                   skipped([](Floats v, Run) {
                       const Offset o = offset(v);
                       v[0] = o.x == -1 && o.y == 0 ? 1.0F : 0.0F;
                   })});
    const auto both_loops = [&](std::string_view name, std::string_view meaning, Formula formula, std::string_view rows,
                                std::string_view columns) {
        static std::deque<Mistake> of_columns; // their place stays
        const Mistake& too = of_columns.emplace_back(at(site::columns, Change::ranged_by_formula, formula));
        all.push_back({name, meaning, at(site::rows, Change::ranged_by_formula, formula, &too)});
        if (rows.empty()) // has a name elsewhere
            return;
        all.push_back({rows, meaning, at(site::rows, Change::ranged_by_formula, formula)});
        all.push_back({columns, meaning, too});
    };
    both_loops(
        "every_second_texel", "loops over the window in steps of 2", [](Floats v, Run) { v[2] = 2.0F; },
        "every_second_row", "every_second_column");
    both_loops(
        "window_shifted_up", "the window is from -range + 1 to range + 1",
        [](Floats v, Run) { v[0] += 1.0F, v[1] += 1.0F; }, "window_shifted_up_in_y", "window_shifted_up_in_x");
    both_loops(
        "window_shifted_down", "the window is from -range - 1 to range - 1",
        [](Floats v, Run) { v[0] -= 1.0F, v[1] -= 1.0F; }, "window_shifted_down_in_y", "window_shifted_down_in_x");
    both_loops(
        "window_from_base_texel_on", "the window is from 0 to range", [](Floats v, Run) { v[0] = 0.0F; },
        "rows_from_base_texel_on", "columns_from_base_texel_on");
    both_loops(
        "window_up_to_base_texel", "the window is from -range to 0", [](Floats v, Run) { v[1] = 0.0F; },
        "rows_up_to_base_texel", "columns_up_to_base_texel");
    both_loops(
        "first_texel_of_window", "a loop over the window has one turn, its first", [](Floats v, Run) { v[1] = v[0]; },
        "first_row_alone", "first_column_alone");
    both_loops(
        "last_texel_of_window", "a loop over the window has one turn, its last", [](Floats v, Run) { v[0] = v[1]; },
        "last_row_alone", "last_column_alone");
    both_loops(
        "window_ends_open", "the loops run to < range", [](Floats v, Run) { v[1] -= 1.0F; }, "", "");
    both_loops(
        "window_begins_late", "the loops run from -range + 1", [](Floats v, Run) { v[0] += 1.0F; }, "", "");
}

} // namespace lockstep::formulas
