#include "crosscheck/report/system_debug_run.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/judge/item_judge.hpp"
#include "crosscheck/judge/item_place.hpp"
#include "crosscheck/judge/item_table.hpp"
#include "crosscheck/judge/pass_names.hpp"
#include "crosscheck/report/item_text.hpp"
#include "gpu/system_side.hpp"
#include "reference/model/error.hpp"

namespace lockstep {

SystemDebugRun::SystemDebugRun(std::shared_ptr<const System> system, std::shared_ptr<SystemSide> gpu,
                               const KnownOperations& known)
    : system_(std::move(system)), gpu_(std::move(gpu)), run_(*system_, *gpu_, known) {}

void SystemDebugRun::go_to(int frame) {
    frame_ = frame;
    if (run_.judged().frame == frame)
        return;
    for (std::size_t pass = 0; pass < system_->passes.size(); ++pass)
        if (runs(pass))
            return come_to(pass);
}

void SystemDebugRun::come_to(std::size_t pass) {
    try {
        run_.go_to(frame_, pass, [this](int) { go_on(); });
    } catch (const Stopped&) {
        frame_ = run_.judged().frame;
        throw;
    }
}

Extent SystemDebugRun::extent(std::size_t pass) const {
    return system_->start.extent(system_->passes[pass]->resource());
}

std::vector<std::string> SystemDebugRun::groups() const {
    std::vector<std::string> names;
    for (const auto& pass : system_->passes)
        names.emplace_back(pass->name());
    return names;
}

std::vector<DebugSelector> SystemDebugRun::selectors() const {
    return {{"pass", "NAME", "look at the items of this pass"},
            {"item", "I|X,Y", "look at this item; in an image its column and row"}};
}

DebugItem SystemDebugRun::select(std::size_t selector, const std::string& argument, DebugItem now) {
    if (selector == 1) {
        const std::uint8_t r = system_->passes[now.group]->resource();
        return {now.group, item_named(argument, system_->schema.resources[r], extent(now.group), system_->name)};
    }
    const std::size_t pass = pass_named(argument, *system_, frame_, "pass");
    if (!runs(pass))
        throw Error(fmt::format("pass: {} does not run in frame {}", argument, frame_));
    return {pass, now.index};
}

DebugItem SystemDebugRun::nearest(DebugItem item) {
    const std::size_t passes = system_->passes.size();
    for (std::size_t i = 0; i < passes; ++i) {
        const std::size_t pass = (item.group + i) % passes;
        if (runs(pass))
            return {pass, std::min(item.index, extent(pass).count() - 1)};
    }
    throw Error(fmt::format("frame {}: no pass of {} runs", frame_, system_->name));
}

std::string SystemDebugRun::name(DebugItem item) const {
    const ItemPass& pass = *system_->passes[item.group];
    return fmt::format("{}, {}", pass.name(),
                       item_name(system_->schema.resources[pass.resource()], extent(item.group), item.index));
}

std::string SystemDebugRun::head(DebugItem item, NumberFormat) {
    return fmt::format("frame {} {}\n", frame_, name(item));
}

std::string SystemDebugRun::show(DebugItem item, NumberFormat format) {
    come_to(item.group);
    return explain_item(run_, item.index, format);
}

std::string SystemDebugRun::why(DebugItem item, NumberFormat) {
    const std::vector<StepRow> all = rows(item);
    return fmt::format("{} in frame {}\n{}", name(item), frame_, item_verdict_text(run_.judged(), item.index, all));
}

std::vector<StepRow> SystemDebugRun::rows(DebugItem item) {
    come_to(item.group);
    return item_rows(run_.judged(), item.index, run_.told(item.index));
}

ItemSteps SystemDebugRun::text(DebugItem item) {
    come_to(item.group);
    const std::optional<ItemSteps> steps = steps_of_item(run_.judged(), item.index);
    return steps ? *steps : DebugRun::text(item);
}

std::vector<ItemVerdict> SystemDebugRun::verdicts(std::size_t group) {
    if (!runs(group))
        return {};
    come_to(group);
    return judge_items(run_.judged());
}

DebugRun::States SystemDebugRun::states(std::size_t group) {
    if (!runs(group))
        return {};
    come_to(group);
    const JudgedPass judged = run_.judged();
    return {judged.reference, judged.gpu};
}

} // namespace lockstep
