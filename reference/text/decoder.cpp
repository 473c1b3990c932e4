#include "reference/text/decoder.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "reference/model/error.hpp"
#include "reference/text/fewer_copies.hpp"
#include "reference/text/subgroup_words.hpp"

namespace lockstep::text {

void lay(const Module& module, std::uint32_t type, std::uint32_t word, MatrixLayout layout, std::vector<Leaf>& leaves) {
    using enum Type::Kind;
    const Type& t = module.types[type];
    constexpr std::uint32_t bytes = 4;
    switch (t.kind) {
    case vector:
        for (std::uint32_t c = 0; c < t.count; ++c)
            lay(module, t.element, word + c, {}, leaves);
        break;
    case matrix:
        for (std::uint32_t c = 0; c < t.count; ++c)
            for (std::uint32_t r = 0; r < module.types[t.element].count; ++r) {
                const std::uint32_t far = (layout.is_row_major ? r : c) * layout.stride / bytes;
                leaves.push_back({word + far + (layout.is_row_major ? c : r), true});
            }
        break;
    case array:
        for (std::uint32_t c = 0; c < t.count; ++c)
            lay(module, t.element, word + c * t.stride / bytes, layout, leaves);
        break;
    case structure:
        for (const Type::Member& m : t.members)
            lay(module, m.type, word + m.offset / bytes, {m.matrix_stride, m.is_row_major}, leaves);
        break;
    default:
        leaves.push_back({word, t.kind == real});
    }
}

std::vector<Leaf> packed_leaves(const Module& module, std::uint32_t type) {
    using enum Type::Kind;
    std::vector<Leaf> leaves;
    const auto add = [&](const auto& self, std::uint32_t of) -> void {
        const Type& t = module.types[of];
        if (t.kind == structure) {
            for (const Type::Member& m : t.members)
                self(self, m.type);
        } else if (t.kind == vector || t.kind == matrix || t.kind == array) {
            for (std::uint32_t c = 0; c < t.count; ++c)
                self(self, t.element);
        } else {
            leaves.push_back({static_cast<std::uint32_t>(leaves.size()), t.kind == real});
        }
    };
    add(add, type);
    return leaves;
}

Decoder::Decoder(const Module& module) : module_(module), cell_(module.ids.size(), none) {
    using enum spv::ExecutionModel;
    if (module.stage != ExecutionModelGLCompute && module.stage != ExecutionModelVertex &&
        module.stage != ExecutionModelGeometry && module.stage != ExecutionModelFragment)
        throw Error(fmt::format("shader {}: the stage is not interpreted; expected a compute, vertex, geometry or "
                                "fragment stage",
                                module.line_name(1)));
    p_.stage = module.stage;
    p_.group = module.group;
    p_.most_vertices = module.most_vertices;
    p_.are_quads = module.are_quads;
    p_.are_square_quads = module.are_square_quads;
    p_.line_name = module.line_name;
    if (p_.are_square_quads && (p_.group[0] % 2 != 0 || p_.group[1] % 2 != 0))
        throw Error(fmt::format("shader {}: a group of {} x {} invocations has no quads; expected even numbers",
                                module.line_name(1), p_.group[0], p_.group[1]));
    // Cells that are zeroed for each invocation come first, of these the outputs.
    outputs();
    for (const Variable& v : module.variables)
        if (v.storage == spv::StorageClassPrivate)
            address_[v.id] = {.place = zeroed_cells(v.id, v.type), .type = v.type};
    for (const Function& f : module.functions)
        inner_variables(f);
    p_.variables = p_.cells;
    p_.scratch = take_cells(4);
    constants();
    outside_variables();
    for (const Function& f : module.functions)
        callee(f);
    last_use_.resize(module.ids.size());
    uses_.resize(module.ids.size());
    for (const Function& f : module.functions) {
        note_uses(f);
        if (f.id == module.entry)
            called_.push_back(&f);
    }
    for (std::size_t k = 0; k < called_.size(); ++k) // calls add to them
        function(*called_[k]);
    if (!step_of_.contains(module.entry))
        throw Error("SPIR-V module without its entry point's function");
    for (const Patch& patch : patches_) {
        const auto to = step_of_.find(patch.label);
        if (to == step_of_.end())
            throw Error(fmt::format("SPIR-V module without block {}", patch.label));
        (patch.field == nullptr ? p_.operands[patch.step] : p_.steps[patch.step].*patch.field) = to->second;
    }
    p_.entry = step_of_.at(module.entry);
    note_written();
}

std::uint32_t Decoder::take_cells(std::uint32_t count) {
    constexpr std::uint32_t most = 1U << 20U;
    const std::uint32_t first = p_.cells;
    p_.cells += count;
    if (p_.cells > most)
        refuse(fmt::format("values of more than {} numbers are not interpreted", most));
    return first;
}

std::uint32_t Decoder::zeroed_cells(std::uint32_t variable, std::uint32_t type_id) {
    const std::uint32_t first = take_cells(type(type_id).cells);
    constexpr std::uint32_t most_parts = 256;
    p_.names.push_back({module_.ids[variable].name, first, type(type_id).cells});
    if (type(type_id).cells <= most_parts)
        note_parts(type_id, "", p_.names.back().parts);
    if (p_.names.back().name.find(counted_name) != std::string::npos) {
        p_.counted.resize(first);
        p_.counted.resize(first + type(type_id).cells, 1);
    }
    return first;
}

void Decoder::note_parts(std::uint32_t type_id, const std::string& name, std::vector<NamedCells::Part>& parts) const {
    const Type& of = type(type_id);
    switch (of.kind) {
    case Type::Kind::structure:
        for (const Type::Member& member : of.members)
            note_parts(member.type, name + "." + member.name, parts);
        return;
    case Type::Kind::vector:
        for (std::uint32_t c = 0; c < of.count; ++c)
            note_parts(of.element, fmt::format("{}.{}", name, "xyzw"[c]), parts);
        return;
    case Type::Kind::matrix:
    case Type::Kind::array:
        for (std::uint32_t k = 0; k < of.count; ++k)
            note_parts(of.element, fmt::format("{}[{}]", name, k), parts);
        return;
    default:
        parts.resize(parts.size() + of.cells,
                     {name, of.kind == Type::Kind::real, of.kind == Type::Kind::boolean, of.is_signed});
    }
}

std::uint32_t Decoder::word_cell(std::uint32_t word) {
    const auto [found, is_new] = word_cells_.try_emplace(word);
    if (is_new) {
        found->second = take_cells(1);
        p_.constants.push_back({found->second, word, false});
    }
    return found->second;
}

std::uint32_t Decoder::cell(std::uint32_t id) {
    if (cell_[id] == none) // a value of a later block
        cell_[id] = take_cells(module_.type_of(id).cells);
    return cell_[id];
}

void Decoder::set_constant(std::uint32_t first, const Constant& from, std::vector<CellWord>& to) {
    const std::vector<Leaf> leaves = packed_leaves(module_, from.type);
    for (std::uint32_t c = 0; c < leaves.size(); ++c)
        to.push_back({first + c, from.words[c], leaves[c].is_real});
}

void Decoder::constants() {
    for (const Constant& one : module_.constants) {
        cell_[one.id] = take_cells(static_cast<std::uint32_t>(one.words.size()));
        set_constant(cell_[one.id], one, p_.constants);
        for (std::uint32_t c = 0; one.is_undefined && c < one.words.size(); ++c)
            p_.undefined.push_back(cell_[one.id] + c);
    }
}

void Decoder::outside_variables() {
    for (const Variable& v : module_.variables) {
        const IdInfo& about = module_.ids[v.id];
        using enum Type::Kind;
        switch (v.storage) {
        case spv::StorageClassUniformConstant:
            if (const Type& of = type(type(v.type).kind == array ? type(v.type).element : v.type);
                of.kind == image || of.kind == sampled_image) {
                this->image(v);
            } else if (module_.scalar_of(v.type).kind == sampler) { // how it samples is its image's here
                address_[v.id] = {.place = take_cells(type(v.type).cells), .type = v.type};
            } else {
                address_[v.id] = {.place = take_cells(type(v.type).cells), .type = v.type};
                plain_uniforms(v.type, address_[v.id].place, about.name);
                if (const Constant* value = module_.constant(v.initializer))
                    set_constant(address_[v.id].place, *value, p_.constants);
            }
            break;
        case spv::StorageClassUniform:
        case spv::StorageClassStorageBuffer:
            block(v, v.storage == spv::StorageClassStorageBuffer || module_.ids[v.type].is_buffer_block);
            break;
        case spv::StorageClassPushConstant:
            block(v, false);
            break;
        case spv::StorageClassAtomicCounter:
            counter(v);
            break;
        case spv::StorageClassWorkgroup:
            address_[v.id] = {.space = Address::Space::shared, .offset = p_.shared, .type = v.type};
            p_.shared_names.push_back({about.name, p_.shared, type(v.type).cells});
            if (v.initializer != 0)
                p_.set_shared.push_back(p_.shared_names.back());
            p_.shared += type(v.type).cells;
            break;
        case spv::StorageClassInput:
            if (p_.stage == spv::ExecutionModelGLCompute || (about.builtin && is_subgroup_input(*about.builtin)))
                input(v);
            else
                stage_input(v);
            break;
        case spv::StorageClassOutput:
        case spv::StorageClassPrivate:
            if (const Constant* value = module_.constant(v.initializer))
                set_constant(address_[v.id].place, *value, p_.initial);
            break;
        default:
            refuse(fmt::format("variable {} of storage class {} is not interpreted", about.name,
                               static_cast<unsigned>(v.storage)));
        }
    }
}

namespace {

/// Of a scalar, vector or matrix, or an array of such.
BasicType basic_type(const Module& module, std::uint32_t id) {
    using enum Type::Kind;
    const Type& scalar = module.scalar_of(id);
    BasicType made{.is_real = scalar.kind == real, .is_boolean = scalar.kind == boolean, .is_signed = scalar.is_signed};
    const Type* of = &module.types[id];
    if (of->kind == array) {
        made.elements = of->count;
        of = &module.types[of->element];
    }
    if (of->kind == matrix) {
        made.columns = of->count;
        of = &module.types[of->element];
    }
    made.rows = of->kind == vector ? of->count : 1;
    return made;
}

} // namespace

/// How many blocks or images an array of them has.
std::uint32_t Decoder::bindings_of(const Variable& variable) const {
    constexpr std::uint32_t most = 1024; // GL has some hundred
    const std::uint32_t count = type(variable.type).count;
    if (count == 0 || count > most)
        refuse(fmt::format("an array of {} blocks or images, {}, is not interpreted; expected 1 to {}", count,
                           module_.ids[variable.id].name, most));
    return count;
}

std::optional<Binding> Decoder::binding(const Variable& variable, std::uint32_t element) const {
    const IdInfo& about = module_.ids[variable.id];
    if (!about.binding)
        return std::nullopt;
    return Binding{about.set.value_or(0), *about.binding, element};
}

void Decoder::block(const Variable& variable, bool is_storage) {
    const bool is_array = type(variable.type).kind == Type::Kind::array;
    const std::uint32_t block_type = is_array ? type(variable.type).element : variable.type;
    const Type& of = type(block_type);
    if (of.kind != Type::Kind::structure)
        refuse(fmt::format("an array of arrays of blocks, {}, is not interpreted", module_.ids[variable.id].name));
    Block made{of.name, is_storage};
    for (const Type::Member& member : of.members)
        made.coherence.push_back(
            {member.offset / word_bytes, member.is_coherent || module_.ids[variable.id].is_coherent});
    if (!of.members.empty())
        if (const Type& last = type(of.members.back().type); last.kind == Type::Kind::array && last.count == 0) {
            made.array_offset = of.members.back().offset;
            made.array_stride = last.stride;
            const Type::Member& member = of.members.back();
            lay(module_, last.element, 0, {member.matrix_stride, member.is_row_major}, made.element);
            Block element;
            block_members(last.element, 0, {member.matrix_stride, member.is_row_major}, member.name, element);
            made.element_members = std::move(element.members);
        }
    if (of.members.size() == 1)
        if (const Type& only = type(of.members.front().type); only.kind == Type::Kind::array) {
            const Type::Member& member = of.members.front();
            Block element;
            block_members(only.element, 0, {member.matrix_stride, member.is_row_major}, member.name, element);
            made.records = Block::Records{only.stride / word_bytes, only.count, std::move(element.members)};
        }
    lay(module_, block_type, 0, {}, made.leaves);
    block_members(block_type, 0, {}, module_.ids[variable.id].name.empty() ? "" : of.name, made);
    address_[variable.id] = {.space = Address::Space::block,
                             .place = static_cast<std::uint32_t>(p_.blocks.size()),
                             .type = variable.type,
                             .is_blocks = is_array};
    for (std::uint32_t i = 0; i < (is_array ? bindings_of(variable) : 1); ++i) {
        p_.blocks.push_back(made);
        p_.blocks.back().binding = binding(variable, i);
        if (is_array)
            p_.blocks.back().name += fmt::format("[{}]", i);
    }
}

/// Of storage blocks without those of structures in arrays, which may be millions.
void Decoder::block_members(std::uint32_t type_id, std::uint32_t word, MatrixLayout layout, const std::string& name,
                            Block& to) const {
    using enum Type::Kind;
    const Type& of = type(type_id);
    if (of.kind == structure) {
        for (const Type::Member& m : of.members)
            block_members(m.type, word + m.offset / word_bytes, {m.matrix_stride, m.is_row_major},
                          name.empty() ? m.name : name + "." + m.name, to);
    } else if (of.kind == array && (type(of.element).kind == structure || type(of.element).kind == array)) {
        for (std::uint32_t i = 0; !to.is_storage && i < of.count; ++i)
            block_members(of.element, word + i * of.stride / word_bytes, layout, fmt::format("{}[{}]", name, i), to);
    } else {
        Block::Member one{name, {}, basic_type(module_, type_id)};
        lay(module_, type_id, word, layout, one.leaves);
        if (!one.leaves.empty())
            to.members.push_back(std::move(one));
    }
}

/// An atomic counter is a buffer of its own: no two of a program share a word (GLSL 4.60, 4.4.6.1).
void Decoder::counter(const Variable& variable) {
    Block made{module_.ids[variable.id].name};
    lay(module_, variable.type, 0, {}, made.leaves);
    address_[variable.id] = {
        .space = Address::Space::block, .place = static_cast<std::uint32_t>(p_.blocks.size()), .type = variable.type};
    p_.blocks.push_back(std::move(made));
}

void Decoder::plain_uniforms(std::uint32_t type_id, std::uint32_t first, const std::string& name) {
    using enum Type::Kind;
    const Type& of = type(type_id);
    if (of.kind == structure) {
        for (const Type::Member& m : of.members) {
            plain_uniforms(m.type, first, name + "." + m.name);
            first += type(m.type).cells;
        }
    } else if (of.kind == array && (type(of.element).kind == structure || type(of.element).kind == array)) {
        for (std::uint32_t i = 0; i < of.count; ++i)
            plain_uniforms(of.element, first + i * type(of.element).cells, fmt::format("{}[{}]", name, i));
    } else {
        const Type& scalar = module_.scalar_of(type_id);
        if (scalar.kind == image || scalar.kind == sampled_image)
            refuse(fmt::format("an array of images, {}, is not interpreted", name));
        p_.uniforms.push_back(
            {name, first, of.cells, scalar.kind == real, scalar.kind == boolean, basic_type(module_, type_id)});
    }
}

namespace {

/// The first line that reads a variable; 0: none does.
std::uint32_t line_of_use(const Module& module, std::uint32_t variable) {
    for (const Function& of : module.functions)
        for (const Instruction& at : of.body)
            if ((at.op == spv::OpLoad || at.op == spv::OpAccessChain) && at.words[2] == variable)
                return at.line;
    return 0;
}

bool is_one_block(const Function& of) {
    return std::count_if(of.body.begin(), of.body.end(), [](const Instruction& at) { return at.op == spv::OpLabel; }) ==
           1;
}

} // namespace

void Decoder::input(const Variable& variable) {
    const IdInfo& about = module_.ids[variable.id];
    line_ = line_of_use(module_, variable.id);
    if (!about.builtin)
        refuse(fmt::format("input {} is not interpreted", about.name));
    switch (*about.builtin) {
    case spv::BuiltInGlobalInvocationId:
    case spv::BuiltInLocalInvocationId:
    case spv::BuiltInWorkgroupId:
    case spv::BuiltInNumWorkgroups:
    case spv::BuiltInLocalInvocationIndex:
    case spv::BuiltInDeviceIndex:
        break;
    default:
        if (!is_subgroup_input(*about.builtin))
            refuse(fmt::format("built-in variable {} is not interpreted", about.name));
        use_subgroups();
    }
    address_[variable.id] = {.place = take_cells(type(variable.type).cells), .type = variable.type};
    p_.inputs.push_back({*about.builtin, address_[variable.id].place, type(variable.type).cells});
}

void Decoder::inner_variables(const Function& of) {
    for (const Instruction& at : of.body)
        if (at.op == spv::OpVariable) {
            line_ = at.line;
            const std::uint32_t pointed = type(at.words[0]).element;
            address_[at.words[1]] = {.place = zeroed_cells(at.words[1], pointed), .type = pointed};
        }
}

/// Parameters that are pointers are copied in, and back where the function stores to them: GLSL's inout (GLSL 4.60,
/// 6.1.1).
void Decoder::callee(const Function& of) {
    Callee made;
    made.result = take_cells(type(of.result).cells);
    for (const std::uint32_t parameter : of.parameters) {
        const Type& t = module_.type_of(parameter);
        if (t.kind != Type::Kind::pointer) {
            made.parameters.push_back(cell(parameter));
            continue;
        }
        if (t.storage == spv::StorageClassAtomicCounter && is_one_block(of)) {
            made.parameters.push_back(none); // where the call stands, it is the counter itself
            continue;
        }
        if (t.storage != spv::StorageClassFunction && t.storage != spv::StorageClassUniformConstant)
            refuse(fmt::format("parameter {} is a pointer into storage class {}, which is not interpreted",
                               module_.ids[parameter].name, static_cast<unsigned>(t.storage)));
        const std::uint32_t first = take_cells(type(t.element).cells);
        address_[parameter] = {.place = first, .type = t.element};
        made.parameters.push_back(first);
        for (const Instruction& at : of.body) {
            const bool hands = at.op == spv::OpFunctionCall &&
                               std::find(at.words.begin() + 3, at.words.end(), parameter) != at.words.end();
            const bool writes =
                (at.op == spv::OpStore && at.words[0] == parameter) ||
                ((at.op == spv::OpAccessChain || at.op == spv::OpInBoundsAccessChain) && at.words[2] == parameter);
            if (t.storage == spv::StorageClassFunction && (hands || writes)) {
                made.written.push_back(static_cast<std::uint32_t>(made.parameters.size() - 1));
                break;
            }
        }
    }
    made.function = &of;
    made.is_block = is_one_block(of);
    callees_[of.id] = std::move(made);
}

Step& Decoder::add(std::uint16_t op) {
    p_.steps.push_back({.op = op});
    p_.lines.push_back(line_);
    p_.stated.push_back(is_stated_ ? 1 : 0);
    p_.precise.push_back(0);
    p_.in_place_of.push_back(in_place_of_);
    maker_ = none;
    return p_.steps.back();
}

Step& Decoder::made(std::uint16_t op, Words w) {
    const std::uint32_t out = cell(w[1]);
    Step& step = add(op);
    step.out = out;
    step.n = static_cast<std::uint16_t>(type(w[0]).cells);
    p_.precise.back() = module_.ids[w[1]].is_precise ? 1 : 0;
    maker_ = w[1];
    return step;
}

/// Counts uses, and finds the last: parts of a value that are named where it lies prolong it.
void Decoder::note_uses(const Function& of) {
    for (std::size_t i = of.body.size(); i-- > 0;) {
        const Instruction& at = of.body[i];
        if (at.op == spv::OpLabel)
            has_phi_[at.words[0]] = i + 1 < of.body.size() && of.body[i + 1].op == spv::OpPhi;
        const bool renames = at.op == spv::OpCompositeExtract || at.op == spv::OpCopyObject ||
                             at.op == spv::OpVectorShuffle || at.op == spv::OpBitcast;
        const std::size_t last = renames ? std::max(i, last_use_[at.words[1]]) : i;
        for (const std::uint32_t word : at.words) // literals among them count too, which does no harm
            if (word < last_use_.size()) {
                last_use_[word] = std::max(last_use_[word], last);
                ++uses_[word];
            }
    }
}

void Decoder::function(const Function& of) {
    function_ = &of;
    step_of_[of.id] = static_cast<std::uint32_t>(p_.steps.size());
    maker_ = none;
    for (std::size_t i = 0; i < of.body.size(); ++i)
        instruction(of.body[i], i);
}

void Decoder::instruction(const Instruction& at, std::size_t number) {
    line_ = at.line;
    is_stated_ = at.has_line;
    switch (at.op) {
    case spv::OpSelectionMerge:
        merge_ = at.words[0];
        return;
    case spv::OpLoopMerge:
        loop_ends_.insert(at.words[0]);
        begins_loop_ = true;
        return;
    case spv::OpNop:
    case spv::OpNoLine:
    case spv::OpLine:
    case spv::OpVariable:
    case spv::OpUndef:
        if (at.op == spv::OpVariable && at.words.size() > 3) {
            const Address to = address_.at(at.words[1]);
            store_to(to, cell(at.words[3]), to.type);
        }
        return;
    default:
        break;
    }
    if (!flow(at) && !(at.op == spv::OpFunctionCall ? (call(at.words, number), true) : memory(at, number)) &&
        !image_operation(at) && !stage_instruction(at) && !subgroup_operation(at) && !operation(at))
        refuse(fmt::format("SPIR-V instruction {} is not interpreted", static_cast<unsigned>(at.op)));
}

std::size_t Block::words(std::size_t count) const {
    std::size_t words = (array_offset + array_stride * count) / word_bytes;
    for (const Leaf& leaf : leaves)
        words = std::max<std::size_t>(words, leaf.word + 1U);
    return words;
}

bool Block::is_coherent(std::uint32_t word) const {
    bool is = false;
    for (const Coherence& one : coherence)
        if (one.word <= word)
            is = one.is_coherent;
    return is;
}

namespace {

std::string_view name_at(const std::vector<NamedCells>& names, std::uint32_t cell) {
    const auto found = std::find_if(names.begin(), names.end(), [&](const NamedCells& one) {
        return cell >= one.first && cell < one.first + one.count;
    });
    return found == names.end() ? "" : std::string_view(found->name);
}

} // namespace

std::string Program::variable_at(std::uint32_t cell) const {
    const std::string_view name = name_at(names, cell);
    return name.empty() ? "a value without a name" : fmt::format("variable {}", name);
}

std::string_view Program::shared_at(std::uint32_t cell) const { return name_at(shared_names, cell); }

Program decoded(const Module& module) {
    Program program = Decoder(module).take();
    program.fewer = with_fewer_copies(program);
    return program;
}

} // namespace lockstep::text
