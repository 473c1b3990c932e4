#include "crosscheck/text/keeping_text.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace lockstep {
namespace {

/// GLSL for a component's word.
std::string word_of(const text::StageVariable& variable, const std::string& name, std::uint32_t component) {
    std::string all = name;
    if (variable.cells > variable.components)
        all += fmt::format("[{}]", component / variable.components);
    if (variable.components > 1)
        all += fmt::format("[{}]", component % variable.components);
    return fmt::format("{}({})", variable.is_real ? "floatBitsToUint" : "uint", all);
}

/// GLSL's name, where GL's begins with that of a block. `vertex`: "[1]", of a geometry stage's input.
std::string name_in(const text::StageVariable& variable, const std::string& vertex) {
    if (variable.builtin)
        return vertex.empty() ? variable.name : fmt::format("gl_in{}.{}", vertex, variable.name);
    const std::size_t dot = std::min(variable.name.find('.'), variable.name.size());
    const std::string first = variable.instance.empty() ? variable.name.substr(0, dot) : variable.instance;
    return first + vertex + variable.name.substr(dot);
}

/// The text's main goes by another name. Definitions before "#undef main" go by another already.
void rename_main(std::string& text) {
    const std::size_t undefined = text.rfind("\n#undef main");
    for (std::size_t at = undefined == std::string::npos ? 0 : undefined;
         (at = text.find("void main(", at)) != std::string::npos;)
        text.replace(at, 10, "void ls_main(");
}

} // namespace

InvocationRecord::InvocationRecord(const text::Program& stage)
    : is_geometry(stage.stage == spv::ExecutionModelGeometry) {
    for (const text::StageVariable& input : stage.stage_inputs)
        if (input.is_read)
            inputs.push_back(&input);
    for (const text::StageVariable& output : stage.stage_outputs)
        for (std::uint32_t c = 0; c < output.cells; ++c)
            if (stage.is_written[output.cell + c] != 0)
                outputs.emplace_back(&output, c);
    if (is_geometry)
        vertices = stage.most_vertices;
}

std::uint32_t InvocationRecord::first_output() const {
    std::uint32_t words = first_input;
    for (const text::StageVariable* input : inputs)
        words += input->words();
    return words;
}

std::uint32_t InvocationRecord::words() const {
    return first_output() + vertices * static_cast<std::uint32_t>(outputs.size());
}

std::string keeping_text(const InvocationRecord& record, std::string text, std::size_t most) {
    std::string before, after;
    std::uint32_t word = InvocationRecord::first_input;
    for (const text::StageVariable* input : record.inputs)
        for (std::uint32_t vertex = 0; vertex < input->vertices; ++vertex) {
            const bool is_single = input->vertices == 1 && input->stride == 0;
            const std::string of_vertex = is_single ? std::string() : fmt::format("[{}]", vertex);
            for (std::uint32_t c = 0; c < input->cells; ++c)
                before +=
                    fmt::format("    ls_keep({}u, {});\n", word++, word_of(*input, name_in(*input, of_vertex), c));
        }
    for (std::size_t k = 0; k < record.outputs.size(); ++k) {
        const auto& [output, component] = record.outputs[k];
        after += fmt::format("    ls_keep({}u + ls_emitted * {}u + {}u, {});\n", word, record.outputs.size(), k,
                             word_of(*output, name_in(*output, {}), component));
    }
    rename_main(text);
    text += fmt::format("{}#undef EmitVertex\n#undef EndPrimitive\n"
                        "layout(std430) buffer LsRecords {{ uint ls_count; uint ls_records[]; }};\n"
                        "uint ls_at = {}u, ls_emitted = 0u, ls_ends = 0u;\n"
                        "void ls_keep(uint word, uint value) {{\n"
                        "    if (ls_at < {}u)\n        ls_records[ls_at * {}u + word] = value;\n}}\n",
                        text.ends_with('\n') ? "" : "\n", most, most, record.words());
    if (record.is_geometry)
        text += fmt::format("void ls_emit_vertex() {{\n{}    ++ls_emitted;\n    EmitVertex();\n}}\n"
                            "void ls_end_primitive() {{\n    ls_ends |= 1u << ls_emitted;\n    EndPrimitive();\n}}\n",
                            after);
    text += fmt::format("void main() {{\n    ls_at = atomicAdd(ls_count, 1u);\n{}    ls_main();\n{}"
                        "    ls_keep(0u, 1u);\n    ls_keep(1u, ls_emitted);\n    ls_keep(2u, ls_ends);\n}}\n",
                        before, record.is_geometry ? "" : after);
    const std::size_t version_end = text.find('\n') + 1, extension = text.rfind("\n#extension");
    const std::size_t head_end = extension == std::string::npos ? version_end : text.find('\n', extension + 1) + 1;
    text.insert(head_end, record.is_geometry
                              ? "#define EmitVertex ls_emit_vertex\n#define EndPrimitive ls_end_primitive\n"
                                "void ls_emit_vertex();\nvoid ls_end_primitive();\n"
                              : "");
    constexpr int with_storage_in_every_stage = 450;
    return fmt::format("#version {} core\n", with_storage_in_every_stage) + text.substr(version_end);
}

text::StageRun run_of(const InvocationRecord& record, std::span<const std::uint32_t> records) {
    text::StageRun run;
    run.invocations = static_cast<std::uint32_t>(records.size() / record.words());
    for (std::uint32_t i = 0; i < run.invocations; ++i) {
        auto at = records.begin() + std::ptrdiff_t{i} * record.words() + InvocationRecord::first_input;
        for (const text::StageVariable* input : record.inputs) {
            std::vector<std::uint32_t>& to = run.inputs[text::name_of(*input)];
            to.insert(to.end(), at, at + input->words());
            at += input->words();
        }
    }
    return run;
}

text::StageResult result_of(const InvocationRecord& record, std::span<const std::uint32_t> records) {
    text::StageResult made;
    for (std::size_t first = 0; first < records.size(); first += record.words()) {
        const std::span<const std::uint32_t> kept = records.subspan(first, record.words());
        const bool has_ended = kept[0] != 0;
        const auto invocation = static_cast<std::uint32_t>(first / record.words());
        made.is_discarded.push_back(has_ended ? 0 : 1);
        const std::uint32_t vertices = record.is_geometry ? kept[1] : 1;
        for (std::uint32_t v = 0; v < vertices; ++v)
            for (std::size_t k = 0; k < record.outputs.size(); ++k) {
                const auto& [output, component] = record.outputs[k];
                std::vector<std::uint32_t>& to = made.outputs[text::name_of(*output)];
                to.resize((made.vertices + v + 1) * output->cells);
                if (has_ended)
                    to[(made.vertices + v) * output->cells + component] =
                        kept[record.first_output() + v * record.outputs.size() + k];
            }
        if (record.is_geometry) {
            std::uint32_t begin = 0;
            for (std::uint32_t v = 1; v <= vertices; ++v)
                if (v == vertices || (kept[2] >> v & 1U) != 0) {
                    made.strips.push_back({invocation, made.vertices + begin, v - begin});
                    begin = v;
                }
        }
        made.vertices += vertices;
    }
    return made;
}

} // namespace lockstep
