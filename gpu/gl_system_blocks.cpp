#include "gpu/gl_system_blocks.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "gpu/state_image.hpp"
#include "reference/model/error.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep {
namespace {

std::string block_name(const Resource& resource, bool after) {
    return shader_name(resource.name) + (after ? "After" : "Before");
}

/// The blocks of ours by their names.
std::map<std::string, BoundBlock> our_blocks(const Schema& schema, const std::vector<SystemStorage>& storages,
                                             const GlPass& pass) {
    std::map<std::string, BoundBlock> all;
    for (std::size_t s = 0; s < storages.size(); ++s) {
        const Resource& resource = schema.resources[storages[s].layout.resource];
        if (storages[s].block.empty()) {
            all[block_name(resource, false)] = {BoundBlock::Kind::before, s, {}};
            all[block_name(resource, true)] = {BoundBlock::Kind::after, s, {}};
        } else {
            all[storages[s].block] = {BoundBlock::Kind::in_place, s, {}};
        }
    }
    for (const auto& [name, words] : pass.data)
        all[name] = {BoundBlock::Kind::data, 0, name};
    for (const auto& [name, target] : pass.names)
        for (std::size_t s = 0; s < storages.size(); ++s)
            if (storages[s].layout.resource == target.resource)
                all[name] = {!storages[s].block.empty()            ? BoundBlock::Kind::in_place
                             : target.kind == GlName::Kind::before ? BoundBlock::Kind::before
                                                                   : BoundBlock::Kind::after,
                             s,
                             {}};
    return all;
}

} // namespace

std::string block_of(const Schema& schema, const SystemStorage& storage, bool after) {
    return storage.block.empty() ? block_name(schema.resources[storage.layout.resource], after) : storage.block;
}

std::vector<SystemStorage> storages_of(const Schema& schema) {
    std::vector<SystemStorage> all;
    for (std::uint8_t r = 0; r < schema.resources.size(); ++r) {
        const Resource& resource = schema.resources[r];
        if (resource.dimensions != 1) {
            static_cast<void>(image_format(resource));
            continue;
        }
        const std::size_t first = all.size();
        for (std::uint8_t f = 0; f < resource.fields.size(); ++f) {
            const auto known =
                std::find_if(all.begin() + static_cast<std::ptrdiff_t>(first), all.end(),
                             [&](const SystemStorage& s) { return s.block == resource.fields[f].block; });
            SystemStorage& storage = known != all.end()
                                         ? *known
                                         : all.emplace_back(SystemStorage{{&schema, r, {}}, resource.fields[f].block});
            storage.layout.members.push_back({f, shader_name(resource.fields[f].name)});
        }
    }
    return all;
}

std::vector<RecordBlocks> blocks_of_records(const Schema& schema, const std::vector<SystemStorage>& storages) {
    std::vector<RecordBlocks> all;
    for (const SystemStorage& storage : storages) {
        const Resource& resource = schema.resources[storage.layout.resource];
        if (storage.block.empty())
            all.push_back(
                {block_name(resource, false), block_name(resource, true), &storage.layout, shader_name(resource.name)});
    }
    return all;
}

std::vector<BoundBlock> bind_blocks(const Program& program, const Schema& schema,
                                    const std::vector<SystemStorage>& storages, const GlPass& pass) {
    const std::map<std::string, BoundBlock> ours = our_blocks(schema, storages, pass);
    std::vector<std::string> names;
    for (const auto& [name, what] : ours)
        names.push_back(name);
    std::vector<BoundBlock> bound;
    std::vector<GLuint> by_member;
    const std::vector<StorageBlock> blocks = storage_blocks(program, names);
    for (GLuint block = 0; block < static_cast<GLuint>(blocks.size()); ++block) {
        if (blocks[block].ours.empty()) {
            by_member.push_back(block);
            continue;
        }
        const auto known = ours.find(blocks[block].ours);
        if (known == ours.end())
            throw Error(fmt::format("{}: nothing is given for storage block {}; right is one of {}, or {} beside the "
                                    "shader (docs/own_shader.md){}",
                                    program.name(), blocks[block].name, fmt::join(names, ", "), bindings_file,
                                    did_you_mean(blocks[block].name, names)));
        gl::ShaderStorageBlockBinding(program.id(), block, static_cast<GLuint>(bound.size()));
        bound.push_back(known->second);
    }
    for (std::size_t b = 0; b < by_member.size(); ++b)
        gl::ShaderStorageBlockBinding(program.id(), by_member[b], static_cast<GLuint>(bound.size() + b));
    return bound;
}

} // namespace lockstep
