#include "gpu/bindings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "reference/model/bounded_json.hpp"
#include "reference/model/error.hpp"
#include "reference/model/near_name.hpp"

namespace lockstep {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 5> sections{"uniforms", "uniform_blocks", "storage_blocks", "attributes",
                                                   "outputs"};

class Reader {
  public:
    Reader(const std::string& file, const FolderNames& names)
        : words_(names.words), storage_blocks_(names.storage_blocks) {
        made_.file = file;
    }

    Bindings read(const std::string& text) {
        const json document = parse_json(text, made_.file);
        check_object("", document);
        for (const auto& [name, value] : document.items()) {
            const std::string path = "/" + name;
            if (std::find(sections.begin(), sections.end(), name) == sections.end())
                fail(path, fmt::format("is none of {}{}", fmt::join(sections, ", "),
                                       did_you_mean(name, {sections.begin(), sections.end()})));
            check_object(path, value);
            if (name == "uniforms")
                read_uniforms(path, "", value);
            else if (name == "uniform_blocks")
                for (const auto& [block, members] : value.items()) {
                    check_object(path + "/" + block, members);
                    check_word(path + "/" + block, block);
                    made_.blocks.push_back(block);
                    read_uniforms(path + "/" + block, block + ".", members);
                }
            else if (name == "storage_blocks")
                for (const auto& [block, members] : value.items())
                    read_storage(path + "/" + block, block, members);
            else
                read_names(path, value, name == "outputs" ? made_.outputs : made_.attributes);
        }
        return std::move(made_);
    }

  private:
    [[noreturn]] void fail(const std::string& path, const std::string& what) const {
        throw Error(fmt::format("{}: {}{}{}", made_.file, path, path.empty() ? "" : ": ", what));
    }

    void check_object(const std::string& path, const json& value) const {
        if (!value.is_object())
            fail(path, "is no object of names; right is { \"name in the shader\": \"name here\" }");
    }

    /// The shaders beside the file have the name.
    void check_word(const std::string& path, const std::string& name) const {
        if (!std::binary_search(words_.begin(), words_.end(), name))
            fail(path, fmt::format("no shader beside it has the name {}{}", name, did_you_mean(name, words_)));
    }

    void read_names(const std::string& path, const json& value,
                    std::map<std::string, std::string, std::less<>>& names) const {
        std::set<std::string> given;
        for (const auto& [theirs, ours] : value.items()) {
            const std::string at = path + "/" + theirs;
            check_word(at, theirs.substr(theirs.rfind('.') + 1)); // of an output in a block "Block.name"
            if (!ours.is_string())
                fail(at, "is no name");
            names[theirs] = ours.get<std::string>();
            if (!given.insert(names[theirs]).second)
                fail(at, fmt::format("{} has a name already", names[theirs]));
        }
    }

    void read_storage(const std::string& path, const std::string& block, const json& value) {
        if (std::find(storage_blocks_.begin(), storage_blocks_.end(), block) == storage_blocks_.end())
            fail(path, fmt::format("no shader beside it declares a storage block {}; {}{}", block,
                                   storage_blocks_.empty()
                                       ? "right is buffer NAME { ... } in a compute shader"
                                       : fmt::format("right is one of {}", fmt::join(storage_blocks_, ", ")),
                                   did_you_mean(block, storage_blocks_)));
        StorageBlockBinding binding{path, value.is_string() ? value.get<std::string>() : std::string()};
        if (value.is_string() ? binding.ours.empty() : !value.is_object() || value.empty())
            fail(path, "must be the name of a block here, or { \"member in the shader\": \"Block.field here\" }");
        if (value.is_object())
            for (const auto& [member, given] : value.items())
                binding.members.emplace(member, read_member(path + "/" + member, member, given));
        made_.storage_blocks.emplace(block, std::move(binding));
    }

    /// A MemberBinding or a UniformBinding.
    template <class Binding> Binding read_values(const std::string& path, const json& value) const {
        Binding binding{path};
        binding.is_list = value.is_array();
        for (const json& one : value.is_array() ? value : json::array({value}))
            if (one.is_string())
                binding.values.emplace_back(one.get<std::string>());
            else if (one.is_number() && std::isfinite(static_cast<float>(one.get<double>())))
                binding.values.emplace_back(one.get<double>());
            else if (one.is_number())
                fail(path, "is beyond what a float holds, 3.4e38");
            else
                fail(path, "is neither a name nor a number, nor a list of these");
        if (binding.values.empty())
            fail(path, "is an empty list; right are names and numbers, one at least");
        return binding;
    }

    MemberBinding read_member(const std::string& path, const std::string& name, const json& value) const {
        check_word(path, name.substr(name.rfind('.') + 1));
        return read_values<MemberBinding>(path, value);
    }

    void read_uniforms(const std::string& path, const std::string& block, const json& value) {
        for (const auto& [theirs, given] : value.items()) {
            const std::string last = theirs.substr(theirs.rfind('.') + 1);
            check_word(path + "/" + theirs, last.substr(0, last.find('[')));
            auto binding = read_values<UniformBinding>(path + "/" + theirs, given);
            constexpr std::string_view function = "transpose(";
            if (auto* name = std::get_if<std::string>(&binding.values.front());
                name != nullptr && name->starts_with(function) && name->ends_with(")")) {
                *name = name->substr(function.size(), name->size() - function.size() - 1);
                binding.transposed = true;
            }
            made_.uniforms.emplace(block + theirs, std::move(binding));
        }
    }

    const std::vector<std::string>&words_, &storage_blocks_;
    Bindings made_;
};

} // namespace

bool Bindings::binds_block(std::string_view block) const {
    return std::find(blocks.begin(), blocks.end(), block) != blocks.end();
}

std::string Bindings::output(std::string_view ours) const {
    const auto found =
        std::find_if(outputs.begin(), outputs.end(), [&](const auto& one) { return one.second == ours; });
    return found == outputs.end() ? std::string(ours) : found->first;
}

std::shared_ptr<const Bindings> parse_bindings(const std::string& file, const std::string& text,
                                               const FolderNames& names) {
    return std::make_shared<const Bindings>(Reader(file, names).read(text));
}

} // namespace lockstep
