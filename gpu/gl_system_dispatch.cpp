#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "gpu/gl_system_parts.hpp"
#include "reference/model/error.hpp"

namespace lockstep {

/// Binds the buffer with the counts and returns their place in it; nothing where they are beyond what GL can dispatch:
/// then as many groups run as the items take.
std::optional<GLintptr> GlSystem::Parts::group_counts(const Linked& linked) {
    const GroupCounts& of = *linked.pass.indirect;
    constexpr std::uint32_t most_groups = 65535; // that every GL has
    for (std::size_t s = 0; s < storages.size(); ++s) {
        if (storages[s].layout.resource != of.field.resource)
            continue;
        std::optional<std::size_t> word;
        storages[s].layout.for_each_member([&](const RecordLayout::Member& member, std::size_t first) {
            if (member.field == of.field.field)
                word = first;
        });
        if (word) {
            const std::size_t place = of.item * storages[s].layout.bytes() + *word * sizeof(std::uint32_t);
            const std::array<std::uint32_t, 3> counts = from(s).three_words(place);
            gl::BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, from(s).id());
            const bool fits = std::all_of(counts.begin(), counts.end(), [](auto n) { return n <= most_groups; });
            if (fits)
                ran_over = std::uint64_t{counts[0]} * counts[1] * counts[2] * linked.invocations;
            return fits ? std::optional(static_cast<GLintptr>(place)) : std::nullopt;
        }
    }
    return {};
}

namespace {

/// Groups of `size` invocations that make `count` along an axis. Throws Error where this context takes fewer.
GLuint groups(std::string_view pass, std::size_t count, std::size_t size, GLuint axis) {
    GLint most = 0;
    gl::GetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, axis, &most);
    const std::size_t needed = (count + size - 1) / size;
    if (needed > static_cast<std::size_t>(most))
        throw Error(fmt::format("{}: {} invocations along {} are more than this context takes; expected at most {}, {} "
                                "groups of {}",
                                pass, count, "xyz"[axis], size * static_cast<std::size_t>(most), most, size));
    return static_cast<GLuint>(needed);
}

} // namespace

void GlSystem::Parts::dispatch(const Linked& linked, int frame) {
    using Kind = BoundBlock::Kind;
    check_given(linked);
    const auto is_copied = [&](std::uint8_t resource) { return kept || !in_place(resource); };
    for (std::size_t s = 0; s < storages.size(); ++s)
        if ((!storages[s].block.empty() || linked.pass.keeps()) && is_copied(storages[s].layout.resource) &&
            std::count(linked.resources.begin(), linked.resources.end(), storages[s].layout.resource) > 0)
            to(s).copy(from(s));
    std::vector<StorageBuffer> given; // lives until the dispatch is done
    for (std::size_t b = 0; b < linked.bound.size(); ++b) {
        const BoundBlock& bound = linked.bound[b];
        const auto point = static_cast<GLuint>(b);
        if (bound.kind == Kind::data) {
            std::vector<float> floats = linked.pass.data.at(bound.name)(frame);
            floats.resize(std::max<std::size_t>(floats.size(), 1));
            StorageBuffer& buffer = given.emplace_back();
            buffer.allocate({bound.name, "float", floats.size(), sizeof(float), {}}, 4 * linked.invocations,
                            floats.data(), GL_STREAM_DRAW);
            buffer.range().bind(point, linked.ends_with_last[b]);
        } else {
            const std::uint8_t resource = storages[bound.storage].layout.resource;
            const bool written = std::count(linked.resources.begin(), linked.resources.end(), resource) > 0;
            const bool after =
                bound.kind == Kind::after || (bound.kind == Kind::in_place && written && is_copied(resource));
            (after ? to(bound.storage) : from(bound.storage)).range("").bind(point, linked.ends_with_last[b]);
        }
    }
    std::vector<const RecordBuffer*> read, written;
    for (std::size_t s = 0; s < storages.size(); ++s)
        if (storages[s].block.empty()) {
            read.push_back(&from(s));
            written.push_back(&to(s));
        }
    linked.by_member.fill(read, written);
    const std::size_t items =
        linked.pass.invocations ? linked.pass.invocations(frame) : this->items(linked.pass.resource);
    ran_over = items;
    std::array<GLuint, 3> counts{};
    for (GLuint axis = 0; axis < 3 && linked.pass.size; ++axis)
        counts[axis] = groups(linked.pass.name, (*linked.pass.size)[axis], linked.group[axis], axis);
    if (linked.pass.size)
        ran_over = std::uint64_t{counts[0]} * counts[1] * counts[2] * linked.invocations;
    // Negative: as many groups as the items take.
    const GLintptr place = linked.pass.indirect ? group_counts(linked).value_or(-1) : -1;
    linked.program.use();
    timed([&] {
        if (linked.pass.size)
            gl::DispatchCompute(counts[0], counts[1], counts[2]);
        else if (place >= 0)
            gl::DispatchComputeIndirect(place);
        else if (is_image(linked.pass.resource) && !linked.pass.invocations)
            dispatch_image(linked);
        else
            gl::DispatchCompute(groups(linked.pass.name, items, linked.invocations, 0), 1, 1);
    });
    const std::string when = fmt::format("frame {}: ", frame);
    linked.by_member.collect(written, when);
    if (!takes_times && !given.empty()) {
        gl::MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        for (const StorageBuffer& buffer : given)
            check_margin(linked.program, buffer.range(), when);
    }
    gl::BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
    gl::MemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT | GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT |
                      GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT |
                      GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                      GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
}

void GlSystem::Parts::dispatch_image(const Linked& linked) {
    const Extent& extent = image_to(linked.pass.resource).extent();
    gl::DispatchCompute(groups(linked.pass.name, extent.width, linked.group[0], 0),
                        groups(linked.pass.name, extent.height, linked.group[1], 1),
                        groups(linked.pass.name, extent.depth, linked.group[2], 2));
}

} // namespace lockstep
