#include "reference/text/races.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <spirv.hpp>

namespace lockstep::text {
namespace {

constexpr std::array<std::string_view, 3> rules{"race on shared memory (GLSL 4.60, 8.16)",
                                                "race on a buffer (GL 4.6, 7.13.1)",
                                                "race on an image (GL 4.6, 7.13.1)"};

constexpr std::string_view coherence_rule = "memory that groups hand on without `coherent` (GLSL 4.60, 4.10)";

std::string_view verb(Races::How how) {
    return how == Races::How::read ? "reads" : how == Races::How::write ? "writes" : "changes by an atomic operation";
}

} // namespace

void Races::start_group(std::uint32_t number) {
    group_ = number;
    ++barriers_;
    for (std::uint32_t& epoch : epochs_)
        ++epoch;
    is_fenced_ = {};
    has_fences_ = false;
    published_ = fences_;
    acquired_.clear();
}

void Races::fence(std::uint32_t semantics, std::uint32_t invocation) {
    if (!has_groups())
        return;
    constexpr BySpace masks{0, spv::MemorySemanticsUniformMemoryMask, spv::MemorySemanticsImageMemoryMask};
    for (std::size_t space = 1; space < masks.size(); ++space)
        if ((semantics & masks[space]) != 0) {
            ++fences_[local(invocation)][space];
            is_fenced_[space] = has_fences_ = true;
        }
}

void Races::barrier(std::uint32_t semantics) {
    for (std::uint32_t i = 0; i < fences_.size(); ++i)
        fence(semantics, i);
    is_fenced_[0] = true; // barrier() orders shared memory by itself (GLSL 4.60, 8.16)
    for (std::size_t space = 0; space < epochs_.size(); ++space)
        epochs_[space] += is_fenced_[space] ? 1 : 0;
    ++barriers_;
    is_fenced_ = {};
    published_ = fences_;
}

bool Races::is_released(const Touch& before, std::size_t space, std::uint32_t invocation) const {
    return std::any_of(acquired_.begin(), acquired_.end(), [&](const Acquired& acquired) {
        const auto covers = [&](const auto& releases, std::uint32_t by, std::uint32_t count) {
            const auto release = releases.find(by);
            return release != releases.end() && release->second.when < acquired.when &&
                   release->second.counts[space] > count;
        };
        return (acquired.invocation == invocation || acquired.barriers < barriers_) &&
               (covers(acquired.from->by_invocation, before.place.invocation, before.fences) ||
                covers(acquired.from->by_group, before.place.invocation / static_cast<std::uint32_t>(fences_.size()),
                       before.epoch));
    });
}

bool Races::is_ordered(const Touch& before, std::size_t space, bool in_group, std::uint32_t invocation) const {
    if (!has_groups())
        return false;
    if (in_group &&
        (space == 0 ? before.epoch < epochs_[0] : published_[local(before.place.invocation)][space] > before.fences))
        return true;
    return is_released(before, space, invocation);
}

void Races::note(std::array<Touch, 2>& slots, const Touch& touch, std::size_t space, bool in_group) const {
    const bool is_free = slots[0].by == nobody || slots[0].by == touch.by ||
                         is_ordered(slots[0], space, in_group, touch.place.invocation);
    slots[is_free ? 0 : 1] = touch;
}

void Races::add(Touches& in, Space space, How how, const Touch& touch, std::string_view name, bool in_group) {
    const auto s = static_cast<std::size_t>(space);
    const auto races = [&](const Touch& before) {
        return before.by != nobody && before.by != touch.by && !is_ordered(before, s, in_group, touch.place.invocation);
    };
    const Touch* before = races(in.write) ? &in.write : nullptr;
    for (std::size_t k = 0; before == nullptr && k < 2; ++k)
        before = how != How::read && races(in.reads[k])       ? &in.reads[k]
                 : how != How::atomic && races(in.atomics[k]) ? &in.atomics[k]
                                                              : nullptr;
    if (before != nullptr)
        found(*before, space, how, touch.place, name, in_group);
    else if (!in_group && how != How::write && in.write.by != nobody && in.write.by != touch.by)
        check_coherence(in.write, how, touch, name);
    if (how == How::write)
        in.write = touch;
    else
        note(how == How::read ? in.reads : in.atomics, touch, s, in_group);
}

/// A write that is not coherent may stay where its own invocation alone sees it, and a read may find what was there
/// before; atomic operations go to the memory itself.
void Races::check_coherence(const Touch& before, How how, const Touch& touch, std::string_view name) {
    has_handed_on_ = true;
    if (before.is_coherent && (how == How::atomic || touch.is_coherent))
        return;
    findings_.add(
        coherence_rule, touch.place,
        [&] {
            return fmt::format("invocation {} {} what invocation {} wrote in another group: {}", touch.place.invocation,
                               verb(how), before.place.invocation, name);
        },
        before.place);
}

void Races::touch(Space space, std::uint32_t number, std::uint32_t word, How how, Place place, std::string_view name,
                  bool is_coherent) {
    const auto s = static_cast<std::size_t>(space);
    const std::uint64_t key = std::uint64_t{s} << 60U | std::uint64_t{number} << 32U | word;
    Word& at = words_[key];
    if (at.in_group.group != group_) {
        at.in_group = {};
        at.in_group.group = group_;
    }
    Touch touch{place, place.invocation, has_groups() ? fences_[local(place.invocation)][s] : 0, epochs_[s],
                is_coherent};
    add(at.in_group, space, how, touch, name, true);
    if (space != Space::shared) {
        touch.by = group_;
        add(at.in_dispatch, space, how, touch, name, false);
    }
    if (how == How::atomic && has_groups())
        synchronize(key, place.invocation);
}

/// An atomic operation: its invocation knows of what those before it on this word let others know of, and lets them.
void Races::synchronize(std::uint64_t word, std::uint32_t invocation) {
    ++now_;
    if (const auto from = released_.find(word); from != released_.end()) {
        const auto known = std::find_if(acquired_.begin(), acquired_.end(), [&](const Acquired& one) {
            return one.from == &from->second && one.invocation == invocation;
        });
        const Acquired made{&from->second, now_, invocation, barriers_};
        if (known == acquired_.end())
            acquired_.push_back(made);
        else
            *known = made;
    }
    if (!has_fences_)
        return;
    Released& to = released_[word];
    to.by_invocation[invocation] = {fences_[local(invocation)], now_};
    to.by_group[group_] = {epochs_, now_};
}

void Races::found(const Touch& before, Space space, How how, Place place, std::string_view name, bool in_group) {
    findings_.add(
        rules[static_cast<std::size_t>(space)], place,
        [&] {
            return fmt::format("invocation {} {} what invocation {} touched {}: {}", place.invocation, verb(how),
                               before.place.invocation,
                               !has_groups()            ? "without an order between"
                               : !in_group              ? "in another group"
                               : space == Space::shared ? "with no barrier between"
                                                        : "without a barrier and a memory barrier between",
                               name);
        },
        before.place);
}

} // namespace lockstep::text
