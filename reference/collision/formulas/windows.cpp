#include "reference/collision/formulas/words.hpp"

#include <cstdlib>
#include <deque>
#include <string_view>

namespace lockstep::formulas {
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
    const auto skipped_for_own = [&](std::string_view name, std::string_view meaning, Formula formula) {
        all.push_back({name, meaning, skipped(formula)});
    };
    skipped_for_own("next_texel_skipped_for_own", "the texel on the right is skipped, and the base texel searched",
                    [](Floats v, Run) { skip_instead(v, 1, 0); });
    skipped_for_own("texel_before_skipped_for_own", "the texel on the left is skipped, and the base texel searched",
                    [](Floats v, Run) { skip_instead(v, -1, 0); });
    skipped_for_own("texel_above_skipped_for_own", "the texel above is skipped, and the base texel searched",
                    [](Floats v, Run) { skip_instead(v, 0, 1); });
    skipped_for_own("texel_below_skipped_for_own", "the texel below is skipped, and the base texel searched",
                    [](Floats v, Run) { skip_instead(v, 0, -1); });
    skipped_for_own("diagonal_texel_skipped_for_own",
                    "the texel above on the right is skipped, and the base texel searched",
                    [](Floats v, Run) { skip_instead(v, 1, 1); });
    skipped_for_own("first_texel_skipped_for_own", "the window's first texel is skipped, and the base texel searched",
                    [](Floats v, Run run) { skip_instead(v, -reach(run), -reach(run)); });
    skipped_for_own("last_texel_skipped_for_own", "the window's last texel is skipped, and the base texel searched",
                    [](Floats v, Run run) { skip_instead(v, reach(run), reach(run)); });
    skipped_for_own("first_of_second_row_skipped_for_own",
                    "the second row's first texel is skipped, and the base texel searched",
                    [](Floats v, Run run) { skip_instead(v, -reach(run), 1 - reach(run)); });
    const auto leaves = [&](std::string_view name, std::string_view meaning, const Site& site, Change change) {
        all.push_back({name, meaning, {.site = site.id, .change = change}});
    };
    using enum Change;
    leaves("row_left_at_border", "a row ends at the first texel outside the image", site::neighbour, loop_left_if_not);
    leaves("search_left_at_border", "the search ends at the first texel outside the image", site::neighbour,
           loops_left_if_not);
    leaves("row_left_at_empty_texel", "a row ends at the first empty texel", site::holds_particle, loop_left_if_not);
    leaves("search_left_at_empty_texel", "the search ends at the first empty texel", site::holds_particle,
           loops_left_if_not);
    leaves("row_left_at_own_texel", "a row ends at the base texel", site::own_texel_skipped, loop_left_if_so);
    leaves("search_left_at_own_texel", "the search ends at the base texel", site::own_texel_skipped, loops_left_if_so);
    all.push_back({"row_left_out_of_range", "a row ends at the first that is not in range",
                   mistake_at(site::in_range, loop_left_if_not, 0)});
    all.push_back({"search_left_out_of_range", "the search ends at the first that is not in range",
                   mistake_at(site::in_range, loops_left_if_not, 0)});
    leaves("row_left_in_range", "a row ends at the first in range", site::in_range, loop_left_if_so);
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
    static const Formula ends_open = [](Floats v, Run) { v[1] -= 1.0F; };
    static const Mistake skips_middle = skipped([](Floats v, Run run) { skip_instead(v, -reach(run), 0); });
    static const Mistake even_columns = at(site::columns, Change::ranged_by_formula, ends_open, &skips_middle);
    all.push_back({"window_of_even_side",
                   "the window has 2 * range rows and columns, and skips their middle texel, not the base texel",
                   at(site::rows, Change::ranged_by_formula, ends_open, &even_columns)});
    static const Mistake tail = skipped([](Floats v, Run run) {
        const int r = reach(run);
        skip_too(v, [&](int x, int y) { return y == r + 2 && x > -r; });
    });
    static const Mistake narrow_columns = at(site::columns, Change::ranged_by_formula, ends_open, &tail);
    all.push_back({"index_split_by_even_side", "one index for both loops is split by 2 * range, not by 2 * range + 1",
                   at(
                       site::rows, Change::ranged_by_formula, [](Floats v, Run) { v[1] += 2.0F; }, &narrow_columns)});
    all.push_back({"index_of_even_side", "one index for both loops ends at (2 * range) * (2 * range)",
                   skipped([](Floats v, Run run) {
                       const int r = reach(run);
                       skip_too(v, [&](int x, int y) { return (y + r) * (2 * r + 1) + x + r >= 4 * r * r; });
                   })});
    all.push_back({"first_texel_left_out", "the window's first texel is not searched", skipped([](Floats v, Run run) {
                       const int r = reach(run);
                       skip_too(v, [&](int x, int y) { return x == -r && y == -r; });
                   })});
    all.push_back({"last_texel_left_out", "the window's last texel is not searched", skipped([](Floats v, Run run) {
                       const int r = reach(run);
                       skip_too(v, [&](int x, int y) { return x == r && y == r; });
                   })});
    all.push_back({"corners_left_out", "the window's corners are not searched", skipped([](Floats v, Run run) {
                       const int r = reach(run);
                       skip_too(v, [&](int x, int y) { return std::abs(x) == r && std::abs(y) == r; });
                   })});
    all.push_back(
        {"outermost_left_out", "the window's outermost texels are not searched", skipped([](Floats v, Run run) {
             const int r = reach(run);
             skip_too(v, [&](int x, int y) { return std::abs(x) == r || std::abs(y) == r; });
         })});
    all.push_back({"odd_offsets_searched", "only texels with an odd tx + ty are searched",
                   skipped([](Floats v, Run) { skip_too(v, [](int x, int y) { return (x + y) % 2 == 0; }); })});
    both_loops(
        "window_not_centred", "the window is from 0 to 2 * range", [](Floats v, Run) { v[1] *= 2.0F, v[0] = 0.0F; },
        "rows_not_centred", "columns_not_centred");
    both_loops(
        "window_begins_early", "the window is from -range - 1 to range", [](Floats v, Run) { v[0] -= 1.0F; },
        "rows_begin_early", "columns_begin_early");
    both_loops(
        "window_ends_late", "the window is from -range to range + 1", [](Floats v, Run) { v[1] += 1.0F; },
        "rows_end_late", "columns_end_late");
    both_loops(
        "window_ends_open", "the loops run to < range", [](Floats v, Run) { v[1] -= 1.0F; }, "", "");
    both_loops(
        "window_begins_late", "the loops run from -range + 1", [](Floats v, Run) { v[0] += 1.0F; }, "", "");
}

} // namespace lockstep::formulas
