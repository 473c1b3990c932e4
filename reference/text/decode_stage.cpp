#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "reference/text/decoder.hpp"

namespace lockstep::text {
namespace {

/// A built-in variable's name in GL where the module has none; empty: it is not interpreted.
std::string_view builtin_name(spv::BuiltIn builtin) {
    static constexpr std::array<std::pair<spv::BuiltIn, std::string_view>, 26> names{
        {{spv::BuiltInPosition, "gl_Position"},
         {spv::BuiltInPointSize, "gl_PointSize"},
         {spv::BuiltInClipDistance, "gl_ClipDistance"},
         {spv::BuiltInCullDistance, "gl_CullDistance"},
         {spv::BuiltInVertexId, "gl_VertexID"},
         {spv::BuiltInInstanceId, "gl_InstanceID"},
         {spv::BuiltInVertexIndex, "gl_VertexIndex"},
         {spv::BuiltInInstanceIndex, "gl_InstanceIndex"},
         {spv::BuiltInBaseVertex, "gl_BaseVertex"},
         {spv::BuiltInBaseInstance, "gl_BaseInstance"},
         {spv::BuiltInDeviceIndex, "gl_DeviceIndex"},
         {spv::BuiltInViewIndex, "gl_ViewIndex"},
         {spv::BuiltInDrawIndex, "gl_DrawID"},
         {spv::BuiltInPrimitiveId, "gl_PrimitiveID"},
         {spv::BuiltInInvocationId, "gl_InvocationID"},
         {spv::BuiltInLayer, "gl_Layer"},
         {spv::BuiltInViewportIndex, "gl_ViewportIndex"},
         {spv::BuiltInFragCoord, "gl_FragCoord"},
         {spv::BuiltInPointCoord, "gl_PointCoord"},
         {spv::BuiltInFrontFacing, "gl_FrontFacing"},
         {spv::BuiltInSampleId, "gl_SampleID"},
         {spv::BuiltInSamplePosition, "gl_SamplePosition"},
         {spv::BuiltInSampleMask, "gl_SampleMask"},
         {spv::BuiltInFragDepth, "gl_FragDepth"},
         {spv::BuiltInHelperInvocation, "gl_HelperInvocation"},
         {spv::BuiltInFragStencilRefEXT, "gl_FragStencilRefARB"}}};
    const auto* const found =
        std::find_if(names.begin(), names.end(), [&](const auto& one) { return one.first == builtin; });
    return found == names.end() ? "" : found->second;
}

/// Locations that a type takes (GLSL 4.60, 4.4.1).
std::uint32_t locations_of(const Module& module, std::uint32_t type) {
    const Type& of = module.types[type];
    std::uint32_t all = 0;
    switch (of.kind) {
    case Type::Kind::structure:
        for (const Type::Member& member : of.members)
            all += locations_of(module, member.type);
        return all;
    case Type::Kind::array:
    case Type::Kind::matrix:
        return of.count * locations_of(module, of.element);
    default:
        return 1;
    }
}

} // namespace

/// Variables of storage class Output, in the first cells.
void Decoder::outputs() {
    for (const Variable& v : module_.variables)
        if (v.storage == spv::StorageClassOutput) {
            address_[v.id] = {.place = take_cells(type(v.type).cells), .type = v.type};
            stage_variables(v, p_.stage_outputs);
        }
    p_.output_cells = p_.cells;
    for (const StageVariable& one : p_.stage_outputs) {
        NamedCells& named = p_.names.emplace_back(NamedCells{one.name, one.cell, one.cells});
        for (std::uint32_t c = 0; c < one.cells; ++c)
            named.parts.push_back({one.cells == 1                ? ""
                                   : one.cells == one.components ? fmt::format(".{}", "xyzw"[c])
                                                                 : fmt::format("[{}]", c),
                                   one.is_real, one.is_boolean, true});
    }
}

void Decoder::stage_input(const Variable& variable) {
    address_[variable.id] = {.place = take_cells(type(variable.type).cells), .type = variable.type};
    stage_variables(variable, p_.stage_inputs);
}

void Decoder::stage_variables(const Variable& variable, std::vector<StageVariable>& to) {
    const IdInfo& about = module_.ids[variable.id];
    StageVariable of{.name = about.name,
                     .instance = {},
                     .location = about.location,
                     .builtin = about.builtin,
                     .variable = address_.at(variable.id).place,
                     .cell = address_.at(variable.id).place,
                     .is_flat = about.is_flat};
    std::uint32_t type_id = variable.type;
    const bool is_input = variable.storage == spv::StorageClassInput;
    if (is_input && p_.stage == spv::ExecutionModelGeometry && type(type_id).kind == Type::Kind::array) {
        of.vertices = type(type_id).count;
        type_id = type(type_id).element;
        of.stride = type(type_id).cells;
    }
    if (module_.ids[type_id].is_block) { // a member's name in GL has the block's, where the block has an instance's
        of.instance = about.name;
        of.name = about.name.empty() ? "" : type(type_id).name;
    }
    stage_variables(of, type_id, to);
}

void Decoder::stage_variables(StageVariable of, std::uint32_t type_id, std::vector<StageVariable>& to) {
    using enum Type::Kind;
    const Type& t = type(type_id);
    const std::string name = of.name;
    if (t.kind == structure) {
        for (const Type::Member& m : t.members) {
            StageVariable member = of;
            member.name = name.empty() || m.builtin ? m.name : name + "." + m.name;
            member.builtin = m.builtin;
            member.is_flat = of.is_flat || m.is_flat;
            if (m.location)
                member.location = m.location;
            stage_variables(member, m.type, to);
            of.cell += type(m.type).cells;
            if (member.location)
                of.location = *member.location + locations_of(module_, m.type);
        }
    } else if (t.kind == array && (type(t.element).kind == structure || type(t.element).kind == array)) {
        for (std::uint32_t i = 0; i < t.count; ++i) {
            of.name = fmt::format("{}[{}]", name, i);
            stage_variables(of, t.element, to);
            of.cell += type(t.element).cells;
            if (of.location)
                *of.location += locations_of(module_, t.element);
        }
    } else {
        if (of.builtin) {
            const std::string_view known = builtin_name(*of.builtin);
            if (known.empty())
                refuse(fmt::format("built-in variable {} is not interpreted", name));
            if (name.empty())
                of.name = known;
        }
        const Type& scalar = module_.scalar_of(type_id);
        while (type(type_id).kind == array || type(type_id).kind == matrix)
            type_id = type(type_id).element;
        of.components = type(type_id).cells;
        of.cells = t.cells;
        of.is_real = scalar.kind == real;
        of.is_boolean = scalar.kind == boolean;
        to.push_back(of);
    }
}

/// Inputs that lie where an address points to, whichever vertex's. An index that is not known may come to each member
/// of a variable that is no built-in one.
void Decoder::note_read(const Address& from) {
    if (from.space != Address::Space::variable)
        return;
    const std::uint32_t first = from.place + from.offset, end = first + type(from.type).cells;
    for (StageVariable& input : p_.stage_inputs) {
        for (std::uint32_t vertex = 0; vertex < input.vertices; ++vertex) {
            const std::uint32_t at = input.cell + vertex * input.stride;
            input.is_read = input.is_read || (first < at + input.cells && at < end);
        }
        if (from.dynamic != none && !input.builtin && input.variable == from.place)
            input.is_read = true;
    }
}

/// Which cells of outputs some step writes. One that no step does is not used by the text.
void Decoder::note_written() {
    p_.is_written.resize(p_.output_cells);
    const auto note = [&](std::uint32_t first, std::uint32_t count) {
        for (std::uint32_t c = first; c < first + count && c < p_.output_cells; ++c)
            p_.is_written[c] = 1;
    };
    for (const Step& step : p_.steps)
        switch (step.op) {
        case code::store_variable: // any of the variable
            for (const StageVariable& one : p_.stage_outputs)
                if (step.a == one.variable && !one.builtin)
                    note(one.cell, one.cells);
            break;
        case code::store_shared:
        case code::store_block:
        case code::store_texel:
        case code::address:
        case code::atomic_shared:
        case code::atomic_block:
        case code::atomic_texel:
            break;
        default:
            if (step.op < code::jump || step.op == code::from_block || step.op >= code::differ_x)
                note(step.out, step.n);
        }
}

/// Instructions of geometry and fragment stages (SPIR-V 3.42.16, 3.42.17 and 3.42.19). Returns false for others.
bool Decoder::stage_instruction(const Instruction& at) {
    switch (at.op) {
    case spv::OpKill:
    case spv::OpTerminateInvocation:
    case spv::OpDemoteToHelperInvocation: // what goes on for its neighbours' sake alone has ended
        add(code::discard);
        return true;
    case spv::OpIsHelperInvocationEXT: // a helper has ended, see above
        cell_[at.words[1]] = word_cell(0);
        return true;
    case spv::OpEmitVertex:
        add(code::emit_vertex);
        return true;
    case spv::OpEndPrimitive:
        add(code::end_primitive);
        return true;
    case spv::OpEmitStreamVertex:
    case spv::OpEndStreamPrimitive:
        refuse("several streams of vertices are not interpreted");
    case spv::OpDPdx:
    case spv::OpDPdxFine:
    case spv::OpDPdxCoarse:
    case spv::OpDPdy:
    case spv::OpDPdyFine:
    case spv::OpDPdyCoarse:
    case spv::OpFwidth:
    case spv::OpFwidthFine:
    case spv::OpFwidthCoarse: {
        const bool is_x = at.op == spv::OpDPdx || at.op == spv::OpDPdxFine || at.op == spv::OpDPdxCoarse,
                   is_y = at.op == spv::OpDPdy || at.op == spv::OpDPdyFine || at.op == spv::OpDPdyCoarse;
        const std::uint32_t a = cell(at.words[2]);
        made(is_x ? code::differ_x : is_y ? code::differ_y : code::differ_both, at.words).a = a;
        return true;
    }
    default:
        return false;
    }
}

} // namespace lockstep::text
