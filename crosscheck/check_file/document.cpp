#include "crosscheck/check_file/document.hpp"

#include <fmt/format.h>

#include "crosscheck/files/plain_text.hpp"

namespace lockstep::check_file {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t most_items = 100'000'000, most_texels_a_side = 16384, most_passes = 255, most_groups = 65535;

Extent size_of_image(const JsonValue& size, int& dimensions) {
    const std::vector<JsonValue> sides = size.items();
    if (sides.size() != 2 && sides.size() != 3)
        size.fail(fmt::format("{} numbers; expected [width, height], or [width, height, depth]", sides.size()));
    dimensions = static_cast<int>(sides.size());
    const auto side = [&](std::size_t k) { return static_cast<std::size_t>(sides[k].integer(1, most_texels_a_side)); };
    Extent extent{side(0), side(1), sides.size() == 3 ? side(2) : 1};
    if (extent.count() > static_cast<std::size_t>(most_items))
        size.fail(fmt::format("{} texels; expected at most {}", extent.count(), most_items));
    return extent;
}

StateEntry read_entry(const std::string& name, const JsonValue& entry) {
    StateEntry made{.name = name, .place = entry, .extent = {}};
    entry.check_keys({"count", "size", "format", "filter", "start"});
    const auto count = entry.find("count"), size = entry.find("size");
    if (count.has_value() == size.has_value())
        entry.fail(count ? "has count and size; expected count for a buffer, or size for an image"
                         : "has neither count nor size; expected count for a buffer, or size for an image");
    if (count)
        made.extent.width = static_cast<std::size_t>(count->integer(1, most_items));
    else
        made.extent = size_of_image(*size, made.dimensions);
    const auto format = entry.find("format"), filter = entry.find("filter");
    if (size)
        made.format = entry.at("format").text();
    else if (format)
        format->fail("is of an image; a buffer's records are as its shaders declare them");
    if (filter && !size)
        filter->fail("is of an image; expected none for a buffer");
    if (filter && filter->choice({"nearest", "linear"}) == 1)
        made.filter = GlFilter::linear;
    if (made.filter && made.format.ends_with('i'))
        filter->fail("is of floats; expected nearest for an image of integers");
    made.start = entry.find("start");
    return made;
}

PassEntry read_pass(const JsonValue& pass) {
    pass.check_keys({"shader", "bind", "groups", "invocations", "uniforms", "inputs"});
    const JsonValue shader = pass.at("shader");
    const fs::path file = shader.text();
    PassEntry made{.name = file.stem().string(), .place = pass};
    if (file.has_parent_path())
        shader.fail("names a folder; expected a file's name, and its folder in \"shaders\"");
    if (file.extension() == ".frag")
        made.stage = Stage::fragment;
    else if (file.extension() != ".comp")
        shader.fail("is no stage of a check file; expected NAME.comp, or NAME.frag for a full-screen pass");
    if (const auto bind = pass.find("bind"))
        for (const std::string& name : bind->keys())
            made.bind.emplace(name, bind->at(name));
    const auto groups = pass.find("groups"), invocations = pass.find("invocations");
    if (made.stage == Stage::fragment && (groups || invocations))
        (groups ? *groups : *invocations).fail("is of a compute stage; a full-screen pass has a fragment a texel");
    if (groups && invocations)
        invocations->fail("stands beside groups; expected one of both");
    if (groups) {
        const std::vector<JsonValue> axes = groups->items();
        if (axes.empty() || axes.size() > 3)
            groups->fail(fmt::format("{} numbers; expected 1 to 3", axes.size()));
        made.groups = {1, 1, 1};
        for (std::size_t k = 0; k < axes.size(); ++k)
            (*made.groups)[k] = static_cast<std::uint32_t>(axes[k].integer(1, most_groups));
        if (const std::uint64_t all = std::uint64_t{(*made.groups)[0]} * (*made.groups)[1] * (*made.groups)[2];
            all > static_cast<std::uint64_t>(most_items))
            groups->fail(fmt::format("{} groups; expected at most {}", all, most_items));
    }
    if (invocations)
        made.invocations = static_cast<std::size_t>(invocations->integer(1, most_items));
    made.uniforms = pass.find("uniforms");
    if (const auto inputs = pass.find("inputs")) {
        if (made.stage != Stage::fragment)
            inputs->fail("is of a fragment stage; a compute stage has none");
        for (const std::string& name : inputs->keys())
            made.inputs.emplace(name, inputs->at(name));
    }
    return made;
}

} // namespace

Document read_document(const JsonValue& document) {
    document.check_keys({"description", "system", "shaders", "reference", "state", "passes", "uniforms", "todo"});
    Document made;
    const JsonValue state = document.at("state");
    for (const std::string& name : state.keys())
        made.state.push_back(read_entry(name, state.at(name)));
    if (made.state.empty())
        state.fail("has no entry; expected a buffer or an image, as { \"boids\": { \"count\": 1000 } }");
    for (const JsonValue& pass : document.at("passes").items())
        made.passes.push_back(read_pass(pass));
    if (made.passes.empty() || made.passes.size() > static_cast<std::size_t>(most_passes))
        document.at("passes").fail(fmt::format("{} passes; expected 1 to {}", made.passes.size(), most_passes));
    made.uniforms = document.find("uniforms");
    return made;
}

} // namespace lockstep::check_file
