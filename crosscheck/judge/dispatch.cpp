#include "crosscheck/judge/dispatch.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "crosscheck/judge/append_judge.hpp"
#include "crosscheck/judge/check.hpp"
#include "crosscheck/judge/item_place.hpp"
#include "gpu/storage_range.hpp"
#include "gpu/system_side.hpp"
#include "reference/model/error.hpp"

namespace lockstep {

namespace {

bool reaches(const SystemSide& gpu, std::size_t pass, const Schema& schema, std::uint8_t resource) {
    for (std::uint8_t f = 0; f < schema.resources[resource].fields.size(); ++f)
        if (gpu.reaches(pass, {resource, f}))
            return true;
    return false;
}

} // namespace

void check_system(const System& system) {
    if (system.passes.empty())
        throw Error(fmt::format("{}: a system without passes does nothing", system.schema.system));
    if (!system.start.is_of(system.schema))
        throw Error(fmt::format("{}: its start is no state of its schema; right is SystemState(schema, sizes)",
                                system.schema.system));
    for (const auto& pass : system.passes) {
        if (pass == nullptr)
            throw Error(fmt::format("{}: a pass is null; right is item_pass(options, twin)", system.schema.system));
        if (pass->resource() >= system.schema.resources.size())
            throw Error(
                fmt::format("{}: pass {} makes the items of no buffer or image", system.schema.system, pass->name()));
        if (system.start.extent(pass->resource()).count() == 0)
            throw Error(fmt::format("{}: nothing would be compared: there are no {}s", system.schema.system,
                                    system.schema.resources[pass->resource()].item));
    }
    for (const NamedMistake& named : system.mistakes) {
        bool known = false;
        for (const auto& pass : system.passes)
            known = known || pass->name() == named.pass;
        if (!known)
            throw Error(fmt::format("{}: mistake {} is made in pass '{}', which there is not", system.schema.system,
                                    named.name, named.pass));
    }
}

std::size_t end_of_dispatch(const System& system, std::size_t first) {
    std::size_t end = first + 1;
    while (end < system.passes.size() && system.passes[end]->continues())
        ++end;
    return end;
}

std::vector<std::uint8_t> written_by(const System& system, std::size_t first) {
    std::vector<std::uint8_t> written;
    for (std::size_t p = first; p < end_of_dispatch(system, first); ++p)
        if (const std::uint8_t r = system.passes[p]->resource();
            std::find(written.begin(), written.end(), r) == written.end())
            written.push_back(r);
    return written;
}

void expect_untouched(const System& system, std::size_t first, const SystemState& before, const SystemState& now,
                      int frame) {
    const ItemPass& pass = *system.passes[first];
    const std::vector<std::uint8_t> written = written_by(system, first);
    for (std::uint8_t r = 0; r < system.schema.resources.size(); ++r) {
        if (std::find(written.begin(), written.end(), r) != written.end())
            continue;
        const auto changed = differing_items(before[r], now[r]);
        if (!changed.empty())
            throw Error(fmt::format("frame {}: {} changed {}; it must write {} alone", frame, pass.name(),
                                    item_name(system.schema.resources[r], now.extent(r), changed.front()),
                                    system.schema.resources[pass.resource()].title));
    }
}

void find_canary(const ItemPass& pass, const SystemState& now, int frame) {
    const View view = now[pass.resource()];
    if (const std::size_t item = find_word(view, canary_word); item < view.count())
        throw Error(fmt::format("frame {}: {} did not write {}: its record still holds what was laid there before; "
                                "a way through it has no store, or stores what GLSL leaves undefined, as 0.0 / 0.0, "
                                "which a compiler may leave out",
                                frame, pass.name(), item_name(view.about(), view.extent, item)));
    if (const std::size_t item = find_word(view, margin_word); item < view.count())
        throw Error(fmt::format("frame {}: {} read past the end of a buffer, and wrote what lies there into {}", frame,
                                pass.name(), item_name(view.about(), view.extent, item)));
}

void expect_left(const SystemSide& gpu, const System& system, std::size_t first, const SystemState& before,
                 const SystemState& now, int frame) {
    for (const std::uint8_t r : written_by(system, first))
        if (gpu.left(before[r]) == false && !differing_items(before[r], now[r]).empty())
            throw Error(fmt::format("frame {}: {} changed {} in the copy that it reads; it must write the other alone",
                                    frame, system.passes[first]->name(), system.schema.resources[r].title));
}

View without_kept(View made, const View& before, const SystemSide& gpu, std::size_t pass) {
    for (std::uint8_t f = 0; f < made.columns.size(); ++f)
        if (made.columns[f] == before.columns[f] && !gpu.reaches(pass, {made.resource, f}))
            made.columns[f] = nullptr;
    return made;
}

void expect_kept(const ItemPass& pass, const View& before, const View& made, int frame) {
    for (const std::uint8_t f : pass.keeps())
        for (std::size_t i = 0; i < made.count(); ++i)
            for (int c = 0; c < made.fields()[f].components; ++c)
                if (!same_bits(before.value(f, i, c), made.value(f, i, c)))
                    throw Error(fmt::format("frame {}: the reference of {} changes {} of {}, which the pass keeps here "
                                            "(ItemPassOptions::keeps of a twin of your own)",
                                            frame, pass.name(), made.fields()[f].name,
                                            item_name(made.about(), made.extent, i)));
}

bool holds_others(const SystemSide& gpu, const System& system, std::size_t first,
                  const std::function<View(std::uint8_t)>& before) {
    const std::vector<std::uint8_t> written = written_by(system, first);
    for (std::uint8_t r = 0; r < system.schema.resources.size(); ++r)
        if (std::ranges::find(written, r) == written.end() && reaches(gpu, first, system.schema, r) &&
            gpu.holds(before(r)) != true)
            return false;
    return true;
}

void put_right(SystemSide& gpu, SystemState& state, const SystemState& right, std::set<std::uint8_t>& wrong) {
    if (wrong.empty())
        return;
    for (const std::uint8_t r : wrong)
        state.take(r, right);
    wrong.clear();
    gpu.upload(std::as_const(state).view());
}

void run_gpu(const System& system, SystemSide& gpu, int frames,
             const std::function<bool(std::size_t pass, int frame, const SystemState& state)>& work) {
    check_system(system);
    SystemState before = system.start, now = system.start;
    gpu.upload(before.view());
    const int repeated_frames = gpu.repeats() ? CheckOptions().repeated_frames : 0;
    for (int frame = 0; frame < frames; ++frame)
        for (std::size_t p = 0; p < system.passes.size(); ++p) {
            const ItemPass& pass = *system.passes[p];
            if (!pass.runs(frame) || pass.continues())
                continue;
            if (frame < repeated_frames)
                gpu.lay_canary(p);
            gpu.step(p, frame);
            gpu.read(now);
            expect_untouched(system, p, before, now, frame);
            if (frame < repeated_frames) {
                find_canary(pass, now, frame);
                SystemState again = now;
                gpu.repeat_step(p, frame);
                gpu.read(again);
                for (const std::uint8_t r : written_by(system, p)) {
                    const View one = std::as_const(now)[r], other = std::as_const(again)[r];
                    if (!compare(one, other).agree() && !pass.unordered() &&
                        !(r == pass.resource() && same_but_for_order(pass, {before.view(), frame}, one, other)))
                        throw Error(fmt::format(
                            "the GPU gave two answers to frame {}, pass {}; check reports where they differ", frame,
                            pass.name()));
                }
                now = std::move(again);
            }
            if (!work(p, frame, now))
                return;
            before = now;
        }
}

} // namespace lockstep
