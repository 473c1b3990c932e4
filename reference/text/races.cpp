#include "reference/text/races.hpp"

#include <string>

#include <fmt/format.h>
#include <spirv.hpp>

namespace lockstep::text {
namespace {

constexpr std::array<std::string_view, 3> rules{"race on shared memory (GLSL 4.60, 8.16)",
                                                "race on a buffer (GL 4.6, 7.13.1)",
                                                "race on an image (GL 4.6, 7.13.1)"};

std::string_view verb(Races::How how) {
    return how == Races::How::read ? "reads" : how == Races::How::write ? "writes" : "changes by an atomic operation";
}

} // namespace

void Races::start_group(std::uint32_t number) {
    group_ = number;
    for (std::uint32_t& epoch : epochs_)
        ++epoch;
    fenced_ = {};
}

void Races::fence(std::uint32_t semantics) {
    fenced_[1] = fenced_[1] || (semantics & spv::MemorySemanticsUniformMemoryMask) != 0;
    fenced_[2] = fenced_[2] || (semantics & spv::MemorySemanticsImageMemoryMask) != 0;
}

void Races::barrier(std::uint32_t semantics) {
    fence(semantics);
    fenced_[0] = true; // barrier() orders shared memory by itself (GLSL 4.60, 8.16)
    for (std::size_t space = 0; space < epochs_.size(); ++space)
        epochs_[space] += fenced_[space] ? 1 : 0;
    fenced_ = {};
}

const Races::Touch* Races::conflict(const Touches& with, How how, std::uint32_t by) {
    const auto is_other = [&](const Touch& touch) { return touch.by != nobody && touch.by != by; };
    if (is_other(with.write))
        return &with.write;
    for (std::size_t k = 0; k < 2; ++k) {
        if (how != How::read && is_other(with.reads[k]))
            return &with.reads[k];
        if (how != How::atomic && is_other(with.atomics[k]))
            return &with.atomics[k];
    }
    return nullptr;
}

void Races::note(Touches& in, How how, Place place, std::uint32_t by) {
    if (how == How::write) {
        in.write = {place, by};
        return;
    }
    std::array<Touch, 2>& slots = how == How::read ? in.reads : in.atomics;
    if (slots[0].by == nobody || slots[0].by == by)
        slots[0] = {place, by};
    else
        slots[1] = {place, by};
}

void Races::touch(Space space, std::uint32_t number, std::uint32_t word, How how, Place place, std::string_view name) {
    const auto s = static_cast<std::uint64_t>(space);
    Word& at = words_[s << 60U | std::uint64_t{number} << 32U | word];
    if (at.in_group.group != group_ || at.in_group.epoch != epochs_[s]) {
        at.in_group = {};
        at.in_group.group = group_;
        at.in_group.epoch = epochs_[s];
    }
    if (const Touch* before = conflict(at.in_group, how, place.invocation))
        found(*before, space, how, place, name, true);
    note(at.in_group, how, place, place.invocation);
    if (space == Space::shared)
        return;
    if (const Touch* before = conflict(at.in_dispatch, how, group_))
        found(*before, space, how, place, name, false);
    note(at.in_dispatch, how, place, group_);
}

void Races::found(const Touch& before, Space space, How how, Place place, std::string_view name, bool in_group) {
    findings_.add(
        rules[static_cast<std::size_t>(space)], place,
        [&] {
            return fmt::format("invocation {} {} what invocation {} touched {}: {}", place.invocation, verb(how),
                               before.place.invocation,
                               !has_groups_             ? "without an order between"
                               : !in_group              ? "in another group"
                               : space == Space::shared ? "with no barrier between"
                                                        : "without a barrier and a memory barrier between",
                               name);
        },
        before.place);
}

} // namespace lockstep::text
