#include "crosscheck/collision/report/collision_debug_run.hpp"

#include <utility>

#include <fmt/format.h>

#include "crosscheck/collision/judge/texel_table.hpp"
#include "crosscheck/collision/report/explain_text.hpp"
#include "crosscheck/collision/report/named_items.hpp"
#include "reference/model/collision/collision_state.hpp"

namespace lockstep {
namespace {

constexpr std::size_t particles = 0, texels = 1;

} // namespace

CollisionDebugRun::CollisionDebugRun(std::unique_ptr<FrameRun> run) : run_(std::move(run)) {}

void CollisionDebugRun::go_to(int frame) {
    table_.reset();
    run_->go_to(frame, [this](int) { go_on(); });
}

std::vector<std::string> CollisionDebugRun::groups() const { return {"particles", "texels"}; }

std::vector<DebugSelector> CollisionDebugRun::selectors() const {
    return {{"particle", "I", "look at particle I"}, {"texel", "X,Y", "look at a texel of the CDT"}};
}

DebugItem CollisionDebugRun::select(std::size_t selector, const std::string& argument, DebugItem) {
    return {selector,
            selector == texels ? texel_named(argument, run_->scene()) : particle_named(argument, run_->scene())};
}

std::string CollisionDebugRun::name(DebugItem item) const {
    const auto width = static_cast<std::size_t>(run_->scene().width);
    return item.group == texels ? fmt::format("texel {},{}", item.index % width, item.index / width)
                                : fmt::format("particle {}", item.index);
}

std::string CollisionDebugRun::head(DebugItem item, NumberFormat format) {
    if (item.group == texels)
        return fmt::format("frame {} {}\n", frame(), name(item));
    if (!table_ || table_->particle != item.index)
        table_ = step_table(*run_, item.index);
    return particle_head(*table_, format);
}

std::string CollisionDebugRun::show(DebugItem item, NumberFormat format) {
    return item.group == texels ? explain_texel(*run_, item.index, format)
                                : explain_particle(*run_, item.index, format);
}

std::string CollisionDebugRun::why(DebugItem item, NumberFormat format) {
    return item.group == texels ? why_texel(*run_, item.index) : why_particle(*run_, item.index, format);
}

std::vector<StepRow> CollisionDebugRun::rows(DebugItem item) {
    if (item.group == texels)
        return texel_table(*run_, item.index).rows;
    table_ = step_table(*run_, item.index);
    return table_->rows;
}

std::vector<ItemVerdict> CollisionDebugRun::verdicts(std::size_t group) {
    return group == particles ? run_->verdicts().particles : run_->verdicts().texels;
}

DebugRun::States CollisionDebugRun::states(std::size_t group) {
    const JudgedFrame frame = run_->judged();
    if (group == particles)
        return {view(frame.reference), view(frame.gpu)};
    return {view(frame.reference_cdt), view(frame.gpu_cdt)};
}

} // namespace lockstep
