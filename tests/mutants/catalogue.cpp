#include "tests/mutants/catalogue.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include <fmt/format.h>

#include "crosscheck/collision/judge/drawn_cause.hpp"
#include "crosscheck/files/json_reader.hpp"
#include "reference/collision/collision_mistakes.hpp"
#include "reference/collision/deviation.hpp"
#include "reference/collision/formula_mistakes.hpp"
#include "reference/model/error.hpp"
#include "tests/mutants/host_faults.hpp"
#include "tests/shipped_shaders.hpp"

namespace lockstep::test {
namespace {

Edit read_edit(const JsonValue& json) {
    Edit edit{json.at("file").text(), json.at("text").text(), json.at("replacement").text()};
    if (const auto times = json.find("times"))
        edit.times = static_cast<int>(times->integer(1, 1000));
    return edit;
}

std::string text_or_nothing(const JsonValue& json, std::string_view key) {
    const auto value = json.find(key);
    return value ? value->text() : std::string();
}

std::map<std::string, std::string> read_texts(const JsonValue& json, std::string_view key) {
    std::map<std::string, std::string> texts;
    if (const auto object = json.find(key))
        for (const std::string& name : object->keys())
            texts[name] = object->at(name).text();
    return texts;
}

DotOrder read_order(const JsonValue& json) {
    const auto names = dot_order_names();
    const auto name = std::find(names.begin(), names.end(), json.text());
    if (name == names.end())
        json.fail("reference/model/profile.hpp has no such order");
    return static_cast<DotOrder>(name - names.begin());
}

Mutant read_mutant(const JsonValue& json, const std::string& pass) {
    Mutant mutant;
    mutant.pass = pass;
    mutant.name = json.at("name").text();
    mutant.cause = text_or_nothing(json, "cause");
    mutant.equivalent = text_or_nothing(json, "equivalent");
    mutant.alike = read_texts(json, "alike");
    mutant.differs_in = read_texts(json, "differs_in");
    if (const auto sums = json.find("sums"))
        mutant.sums = read_order(*sums);
    if (json.find("fault")) {
        json.check_keys({"name", "fault", "cause", "alike", "differs_in", "equivalent", "sums"});
        mutant.fault = json.at("fault").text();
        if (!is_host_fault(mutant.fault))
            json.at("fault").fail("host_faults.cpp has no such fault");
    } else if (json.find("edits")) {
        json.check_keys({"name", "edits", "cause", "alike", "differs_in", "equivalent", "sums"});
        for (const JsonValue& edit : json.at("edits").items()) {
            edit.check_keys({"file", "text", "replacement", "times"});
            mutant.edits.push_back(read_edit(edit));
        }
    } else {
        json.check_keys(
            {"name", "file", "text", "replacement", "times", "cause", "alike", "differs_in", "equivalent", "sums"});
        mutant.edits.push_back(read_edit(json));
    }
    const auto table = deviation_table();
    const auto searches = search_mistakes();
    const bool is_other = !makes_listing(pass) &&
                          (mutant.cause.find(": ") != std::string::npos || DrawnCauseFinder::knows(mutant.cause) ||
                           std::any_of(searches.begin(), searches.end(), [&](const SearchMistake& m) {
                               return m.pass == pass && m.name == mutant.cause;
                           }));
    // Two names that together are the mistake: "a + b".
    const std::size_t plus = mutant.cause.find(" + ");
    const auto is_named = [&](std::string_view name) {
        const auto has = [&](const auto& all) {
            return std::any_of(all.begin(), all.end(), [&](const auto& info) { return info.name == name; });
        };
        return has(table) || has(formula_mistakes());
    };
    const std::string_view cause = mutant.cause;
    const bool named = plus == std::string_view::npos
                           ? is_named(cause)
                           : is_named(cause.substr(0, plus)) && is_named(cause.substr(plus + 3));
    if (!mutant.cause.empty() && !is_other && !named)
        json.at("cause").fail("reference/collision/deviation.hpp has no such deviation");
    return mutant;
}

std::string content(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Replaces each `edit.text`; how many there were.
int replace_each(std::string& shader, const Edit& edit) {
    int found = 0;
    for (std::size_t at = shader.find(edit.text); at != std::string::npos;
         at = shader.find(edit.text, at + edit.replacement.size())) {
        shader.replace(at, edit.text.size(), edit.replacement);
        ++found;
    }
    return found;
}

} // namespace

bool makes_listing(std::string_view pass) { return pass == "collision_pass" || pass == "compute_collision_pass"; }

std::string Mutant::where() const {
    if (!fault.empty())
        return "host";
    std::string files;
    for (const Edit& edit : edits)
        if (files.find(edit.file) == std::string::npos)
            files += (files.empty() ? "" : ", ") + edit.file;
    return files;
}

std::vector<Mutant> read_catalogue(const std::filesystem::path& file, const std::string& pass) {
    const nlohmann::json document = read_json(file);
    std::vector<Mutant> mutants;
    std::set<std::string> names;
    for (const JsonValue& item : JsonValue(document, file.string()).items()) {
        mutants.push_back(read_mutant(item, pass));
        if (!names.insert(mutants.back().name).second)
            item.at("name").fail("the name of another mutant, too");
    }
    return mutants;
}

std::vector<Mutant> whole_catalogue() {
    std::vector<Mutant> mutants = read_catalogue("tests/mutants/shaders.json");
    const auto add = [&](const std::vector<Mutant>& more) { mutants.insert(mutants.end(), more.begin(), more.end()); };
    add(read_catalogue("tests/mutants/host.json"));
    for (const char* pass : {"compute_collision_pass", "octree_pass", "depth_pass", "layered_collision_pass"})
        add(read_catalogue(std::filesystem::path("tests/mutants") / pass += ".json", pass));
    return mutants;
}

std::vector<Mutant> on_driver(std::vector<Mutant> catalogue, const Profile& profile) {
    const auto is_one_of = [](DotOrder order, DotOrder first, const std::vector<DotOrder>& others) {
        return order == first || std::find(others.begin(), others.end(), order) != others.end();
    };
    for (Mutant& mutant : catalogue)
        if (mutant.sums && is_one_of(*mutant.sums, profile.length_order(), profile.other_orders.length) &&
            is_one_of(*mutant.sums, profile.normalize_order(), profile.other_orders.normalize))
            mutant.equivalent = fmt::format("This driver's length and normalize are {} too, with `precise` or without.",
                                            dot_order_names()[static_cast<std::size_t>(*mutant.sums)]);
    return catalogue;
}

void plant(const Mutant& mutant, const TemporaryFolder& folder) {
    for (const Edit& edit : mutant.edits) {
        const bool planted = std::filesystem::exists(folder.path() / edit.file);
        std::string shader = content((planted ? folder.path() : shipped_shaders(edit.file)) / edit.file);
        if (const int found = replace_each(shader, edit); found != edit.times)
            throw Error(fmt::format("mutant {}: the text to replace stands {} times in {}, not {}", mutant.name, found,
                                    edit.file, edit.times));
        folder.write(edit.file, shader);
    }
}

} // namespace lockstep::test
