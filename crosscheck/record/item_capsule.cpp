#include "crosscheck/record/item_capsule.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crosscheck/files/asked_memory.hpp"
#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/judge/item_judge.hpp"
#include "crosscheck/judge/item_place.hpp"
#include "crosscheck/judge/pass_names.hpp"
#include "crosscheck/record/capsule_parts.hpp"
#include "crosscheck/report/item_text.hpp"
#include "crosscheck/scene/profile_json.hpp"
#include "reference/model/error.hpp"
#include "reference/system/stored_pass.hpp"

namespace lockstep {
namespace {

using nlohmann::json;

constexpr std::int64_t version = 1;

void set_words(SystemState& state, std::uint8_t resource, std::size_t item, const std::vector<std::uint32_t>& words) {
    std::size_t at = 0;
    for (const Component& c : components(state.schema().resources[resource]))
        state.set({resource, c.field}, item, words[at++], c.component);
}

std::size_t words_in(const Resource& resource) { return item_bytes(resource) / sizeof(std::uint32_t); }

std::vector<Extent> extents_of(const SystemState& state) {
    std::vector<Extent> extents;
    for (std::uint8_t r = 0; r < state.schema().resources.size(); ++r)
        extents.push_back(state.extent(r));
    return extents;
}

/// Calls `work` with the capsule's step as a judged pass.
template <class Work> auto with_judged(const ItemCapsule& capsule, const System& system, const Work& work) {
    const auto stored =
        stored_pass(*system.passes[pass_named(capsule.pass, system, capsule.frame, "pass")], system.schema);
    const ItemPass& pass = *stored;
    const SystemView before = capsule.before.view();
    SystemState reference = capsule.before;
    pass.run({before, capsule.frame}, capsule.profile, capsule.item, capsule.item + 1, reference[pass.resource()]);
    const View reference_view = std::as_const(reference)[pass.resource()];
    const View gpu_view = capsule.gpu[pass.resource()];
    return work(
        JudgedPass{pass, capsule.profile, capsule.known, capsule.frame, before, reference_view, gpu_view, nullptr});
}

/// The items that any legal run of the step reads.
std::set<ItemId> items_read(const JudgedPass& judged, std::size_t item) {
    std::set<ItemId> read;
    SystemView watched = judged.before;
    watched.read = &read;
    const PassInput in{watched, judged.frame};
    static_cast<void>(judged.pass.outcomes(in, item, judged.profile, judged.known, &judged.gpu));
    static_cast<void>(judged.pass.outcomes(in, item, judged.profile, judged.known, nullptr));
    static_cast<void>(judged.pass.record(in, item, judged.profile));
    return read;
}

json state_json(const SystemState& state, const std::set<ItemId>& items) {
    json list = json::array();
    for (const ItemId& id : items)
        list.push_back(
            {state.schema().resources[id.resource].name, id.item, words_text(item_words(state[id.resource], id.item))});
    return list;
}

std::set<ItemId> items_that_hold(const SystemState& state) {
    std::set<ItemId> items;
    for (std::uint8_t r = 0; r < state.schema().resources.size(); ++r)
        for (std::size_t i = 0; i < state.extent(r).count(); ++i) {
            const auto words = item_words(state[r], i);
            if (std::any_of(words.begin(), words.end(), [](std::uint32_t word) { return word != 0; }))
                items.insert({r, i});
        }
    return items;
}

void read_state(const JsonValue& value, SystemState& state) {
    std::vector<std::string_view> names;
    for (const Resource& resource : state.schema().resources)
        names.push_back(resource.name);
    for (const JsonValue& item : value.items()) {
        const std::vector<JsonValue> parts = item.items();
        if (parts.size() != 3)
            item.fail("not [buffer, item, words]");
        const auto resource = static_cast<std::uint8_t>(parts[0].choice(names));
        const auto count = static_cast<std::int64_t>(state.extent(resource).count());
        if (count == 0)
            item.fail("of a buffer that is empty");
        const auto index = static_cast<std::size_t>(parts[1].integer(0, count - 1));
        set_words(state, resource, index, read_words(parts[2], words_in(state.schema().resources[resource])));
    }
}

json told_json(const std::vector<ToldValue>& told) {
    json list = json::array();
    for (const ToldValue& value : told) {
        std::vector<std::uint32_t> words;
        for (const float x : value.values)
            words.push_back(std::bit_cast<std::uint32_t>(x));
        list.push_back({value.output, words_text(words)});
    }
    return list;
}

std::vector<ToldValue> read_told(const JsonValue& value) {
    std::vector<ToldValue> told;
    for (const JsonValue& item : value.items()) {
        const std::vector<JsonValue> parts = item.items();
        if (parts.size() != 2)
            item.fail("not [output, words]");
        ToldValue one{parts[0].label(), {}};
        for (const std::uint32_t word : read_words(parts[1], 0))
            one.values.push_back(std::bit_cast<float>(word));
        told.push_back(std::move(one));
    }
    return told;
}

std::vector<Extent> read_extents(const JsonValue& value, const Schema& schema) {
    std::vector<Extent> extents;
    std::uint64_t words = 0;
    for (const JsonValue& item : value.items()) {
        const std::vector<JsonValue> parts = item.items();
        if (parts.size() != 3 || extents.size() == schema.resources.size())
            item.fail(fmt::format("not [width, height, depth] of the {} buffers and images", schema.resources.size()));
        std::array<std::size_t, 3> size{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            size[axis] = static_cast<std::size_t>(parts[axis].integer(0, 1 << 26));
        words += std::uint64_t{size[0]} * size[1] * size[2] * words_in(schema.resources[extents.size()]);
        if (words > (std::uint64_t{1} << 30U))
            item.fail("more than 4 GB of state");
        extents.push_back({size[0], size[1], size[2]});
    }
    return extents;
}

/// A pass_argument.
std::string read_pass(const JsonValue& value, const System& system) {
    std::vector<std::string_view> names;
    for (std::size_t p = 0; p < system.passes.size(); ++p) {
        if (value.label() == std::to_string(p))
            return value.label();
        names.push_back(system.passes[p]->name());
    }
    return std::string(names[value.choice(names)]);
}

} // namespace

ItemCapsule cut_item_capsule(SystemRun& run, std::size_t item, const std::string& renderer) {
    JudgedPass judged = run.judged();
    judged.text = nullptr; // a capsule has no shaders
    const std::uint8_t resource = judged.pass.resource();
    if (item >= judged.gpu.count())
        throw Error(fmt::format("there is no {} {}; {} has 0 to {}", judged.gpu.about().item, item, run.system().name,
                                judged.gpu.count() - 1));
    ItemCapsule capsule{.system = run.system().schema.system,
                        .renderer = renderer,
                        .pass = pass_argument(run.system(), run.pass(), judged.frame),
                        .frame = judged.frame,
                        .item = item,
                        .profile = judged.profile,
                        .known = judged.known,
                        .before = SystemState(run.system().schema, extents_of(run.system().start)),
                        .gpu = SystemState(run.system().schema, extents_of(run.system().start)),
                        .told = run.told(item)};
    std::set<ItemId> read = items_read(judged, item);
    read.insert({resource, item});
    for (const ItemId& id : read)
        set_words(capsule.before, id.resource, id.item, item_words(judged.before[id.resource], id.item));
    set_words(capsule.gpu, resource, item, item_words(judged.gpu, item));
    const std::string of_run = explain_item(judged, item, capsule.told, NumberFormat::hexadecimal);
    if (item_capsule_text(capsule, run.system(), NumberFormat::hexadecimal) != of_run)
        throw Error(
            fmt::format("{} in frame {}: its capsule would be judged otherwise than the run; its twin reads what "
                        "is not in the state",
                        item_name(judged.gpu.about(), judged.gpu.extent, item), judged.frame));
    return capsule;
}

std::string item_capsule_file(const ItemCapsule& capsule, const System& system) {
    const SystemState& state = capsule.before;
    const auto look = [&](const Profile& watched) {
        ItemCapsule looked_into = capsule;
        looked_into.profile = watched;
        static_cast<void>(item_capsule_text(looked_into, system));
    };
    json extents = json::array();
    for (const Extent& extent : extents_of(state))
        extents.push_back({extent.width, extent.height, extent.depth});
    const json document{{"lockstep_item_capsule", version},
                        {"system", capsule.system},
                        {"pass", capsule.pass},
                        {"renderer", capsule.renderer},
                        {"frame", capsule.frame},
                        {"item", capsule.item},
                        {"profile", profile_json(capsule.profile)},
                        {"roots", roots_json(capsule.profile, look)},
                        {"known", known_json(capsule.known)},
                        {"extents", extents},
                        {"before", state_json(state, items_that_hold(state))},
                        {"gpu", state_json(capsule.gpu, items_that_hold(capsule.gpu))},
                        {"told", told_json(capsule.told)}};
    std::string text = document.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
    if (text.size() > largest_capsule)
        throw Error(fmt::format("{} {} in frame {}: its capsule would be {} bytes, right is at most {}", capsule.pass,
                                capsule.item, capsule.frame, text.size(), largest_capsule));
    return text;
}

ItemCapsule load_item_capsule(const std::filesystem::path& file, const System& system) {
    const json document = read_json(file);
    return read_item_capsule(JsonValue(document, file.string()), system);
}

ItemCapsule read_item_capsule(const JsonValue& value, const System& system) {
    if (!value.find("lockstep_item_capsule"))
        value.fail("no capsule of an item: the key \"lockstep_item_capsule\" is missing");
    static_cast<void>(value.at("lockstep_item_capsule").integer(version, version));
    value.check_keys({"lockstep_item_capsule", "system", "pass", "renderer", "frame", "item", "profile", "roots",
                      "known", "extents", "before", "gpu", "told"});
    const std::string_view right[] = {system.schema.system};
    static_cast<void>(value.at("system").choice(right));
    ItemCapsule capsule;
    capsule.system = system.schema.system;
    capsule.pass = read_pass(value.at("pass"), system);
    capsule.renderer = value.at("renderer").label();
    capsule.frame = static_cast<int>(value.at("frame").integer(0, 1'000'000'000));
    const ItemPass& pass = *system.passes[pass_named(capsule.pass, system, capsule.frame, "pass")];
    capsule.profile = read_profile(value.at("profile"));
    capsule.profile.roots = read_roots(value.at("roots"));
    capsule.known = read_known(value.at("known"));
    const auto extents = read_extents(value.at("extents"), system.schema);
    capsule.before = SystemState(system.schema, extents);
    capsule.gpu = capsule.before;
    const auto count = static_cast<std::int64_t>(capsule.gpu.extent(pass.resource()).count());
    if (count == 0)
        value.at("extents").fail("the pass's buffer is empty");
    capsule.item = static_cast<std::size_t>(value.at("item").integer(0, count - 1));
    read_state(value.at("before"), capsule.before);
    read_state(value.at("gpu"), capsule.gpu);
    capsule.told = read_told(value.at("told"));
    return capsule;
}

std::string item_capsule_text(const ItemCapsule& capsule, const System& system, NumberFormat format) {
    return with_judged(capsule, system, [&](const JudgedPass& judged) {
        return explain_item(judged, capsule.item, capsule.told, format);
    });
}

ItemVerdict judge(const ItemCapsule& capsule, const System& system) {
    return with_judged(capsule, system, [&](const JudgedPass& judged) { return judge_item(judged, capsule.item); });
}

} // namespace lockstep
