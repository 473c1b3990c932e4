#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "reference/text/program.hpp"

namespace lockstep::text {

/// How a type lies in a block (GLSL 4.60, 4.4.5): matrices have their stride and order from the member they are of.
struct MatrixLayout {
    std::uint32_t stride = 0; ///< bytes
    bool is_row_major = false;
};

/// The scalars of a type in a block, from `word` on, in the order of its cells.
void lay(const Module& module, std::uint32_t type, std::uint32_t word, MatrixLayout matrix, std::vector<Leaf>& leaves);
/// The same of a type whose scalars lie one after the other.
std::vector<Leaf> packed_leaves(const Module& module, std::uint32_t type);

/// Makes steps of a module's functions. Files: decoder.cpp what is declared, decode_stage.cpp inputs and outputs of
/// stages, decode_flow.cpp branches and calls, decode_memory.cpp pointers, loads and stores, decode_operations.cpp the
/// rest.
class Decoder {
  public:
    explicit Decoder(const Module& module);
    Program take() { return std::move(p_); }

  private:
    using Words = std::span<const std::uint32_t>;
    static constexpr std::uint32_t none = no_cell;

    /// Where a pointer points to. Offsets are cells of variables and of shared memory, words of blocks.
    struct Address {
        enum class Space : std::uint8_t { variable, shared, block, texel };
        Space space = Space::variable;
        std::uint32_t place = 0;  ///< a variable's first cell, a block's number, an image's cell
        std::uint32_t offset = 0; ///< besides that of the cell below
        std::uint32_t dynamic = none;
        std::uint32_t type = 0; ///< of what lies there
        MatrixLayout matrix = {};
        bool is_blocks = false; ///< an array of blocks, of which `place` is the first
        bool is_column = false; ///< a vector whose components lie `matrix.stride` apart
    };
    struct Patch {
        std::uint32_t step, label;
        std::uint32_t Step::*field; ///< null: operand number `step`
    };
    struct Callee {
        std::uint32_t result = 0;              ///< first cell
        std::vector<std::uint32_t> parameters; ///< first cells
        std::vector<std::uint32_t> written;    ///< parameters that are pointers: stored to by it
        const Function* function = nullptr;
        bool is_block = false; ///< one block alone: takes the place of its calls
    };

    [[noreturn]] void refuse(const std::string& what) const { module_.refuse(line_, what); }
    std::uint32_t take_cells(std::uint32_t count);
    std::uint32_t zeroed_cells(std::uint32_t variable, std::uint32_t type); ///< zero for each invocation at first
    void note_parts(std::uint32_t type, const std::string& name, std::vector<NamedCells::Part>& parts) const;
    std::uint32_t word_cell(std::uint32_t word); ///< a cell that holds this constant
    std::uint32_t cell(std::uint32_t id);
    const Type& type(std::uint32_t id) const { return module_.types[id]; }
    bool is_real(std::uint32_t type) const { return module_.scalar_of(type).kind == Type::Kind::real; }

    // What is declared.
    void constants();
    void set_constant(std::uint32_t first, const Constant& from, std::vector<CellWord>& to);
    void outside_variables();
    [[nodiscard]] std::uint32_t bindings_of(const Variable& variable) const;
    [[nodiscard]] std::optional<Binding> binding(const Variable& variable, std::uint32_t element) const;
    void block(const Variable& variable, bool is_storage);
    void block_members(std::uint32_t type, std::uint32_t word, MatrixLayout layout, const std::string& name,
                       Block& to) const;
    void counter(const Variable& variable);
    void image(const Variable& variable);
    void plain_uniforms(std::uint32_t type, std::uint32_t cell, const std::string& name);
    void input(const Variable& variable);
    void outputs();
    void stage_input(const Variable& variable);
    void stage_variables(const Variable& variable, std::vector<StageVariable>& to);
    void stage_variables(StageVariable of, std::uint32_t type, std::vector<StageVariable>& to);
    void note_read(const Address& from);
    void note_written();
    void inner_variables(const Function& function);
    void callee(const Function& function);

    // Steps.
    Step& add(std::uint16_t op);
    Step& made(std::uint16_t op, Words w); ///< with a result of its own
    void function(const Function& function);
    void note_uses(const Function& function);
    void in_place(Words w, std::size_t number, const Callee& callee);
    void take_result(Words w, std::size_t number, std::uint32_t first, bool stays);
    void copy(std::uint32_t to, std::uint32_t from, std::uint32_t n);
    const Address* pointed(std::uint32_t id) const;
    void instruction(const Instruction& at, std::size_t number);
    bool flow(const Instruction& at);
    bool memory(const Instruction& at, std::size_t number);
    bool operation(const Instruction& at);
    bool stage_instruction(const Instruction& at);
    bool image_operation(const Instruction& at);
    bool subgroup_operation(const Instruction& at);
    void use_subgroups();
    void leave_to_driver(std::string_view choice); ///< a literal
    void interpolate(Words w);
    void atomic(const Instruction& at);
    void extended(Words w);
    void parts_of_number(Words w);
    struct ImageOperands {
        std::uint32_t mask = 0, level = 0, offset = 0, sample = 0; ///< ids; 0: none
    };
    static ImageOperands image_operands(Words w, std::size_t from);
    void sample_image(const Instruction& at);
    void read_image(const Instruction& at);
    void write_image(const Instruction& at);
    void compared_texel(std::uint32_t out, std::uint32_t reference, std::uint32_t texel);
    std::uint32_t place_of_sample(std::uint32_t place, std::uint32_t axes, std::uint32_t sample);
    std::uint32_t projected(std::uint32_t numbers, std::uint32_t n, std::uint32_t by);
    std::uint32_t moved_place(std::uint32_t place, std::uint32_t axes, std::uint32_t offset, std::uint32_t moved);
    void composite(const Instruction& at);
    void call(Words w, std::size_t number);
    void access(Words w);
    void load(Words w, std::size_t number);
    void store(Words w);
    void load_from(const Address& from, std::uint32_t out, std::uint32_t type);
    void store_to(const Address& to, std::uint32_t from, std::uint32_t type);
    bool takes_store(const Address& to, std::uint32_t id);
    Address member(Address of, std::uint32_t number) const;
    std::uint32_t offset_cell(const Address& of);
    std::uint32_t leaves_of(const Address& of, std::uint32_t type);
    std::pair<std::uint32_t, std::uint32_t> part(std::uint32_t type,
                                                 Words indices) const; ///< cells before it, its type
    /// Whether the variable at these cells stays as it is from an instruction to the last use of what it made.
    bool lasts(std::uint32_t id, std::size_t number, std::uint32_t first, std::uint32_t count);
    void jump_to(std::uint32_t step, std::uint32_t Step::*field, std::uint32_t label);
    void note_decision(Words w, bool is_switch);

    const Module& module_;
    Program p_;
    std::vector<std::uint32_t> cell_;                                       ///< of values, by id
    std::unordered_map<std::uint32_t, Address> address_;                    ///< of pointers, by id
    std::unordered_map<std::uint32_t, std::uint32_t> word_cells_, step_of_; ///< by word; of labels and functions
    std::unordered_map<std::uint32_t, Callee> callees_;
    std::vector<std::size_t> last_use_; ///< by id: number of the instruction in its function
    std::vector<std::uint32_t> uses_;
    std::unordered_map<std::uint32_t, bool> has_phi_;            ///< of labels
    std::vector<std::pair<std::uint32_t, std::uint32_t>> begun_; ///< of a function's variables: cell, initial value
    std::vector<Patch> patches_;
    std::vector<const Function*> called_; ///< functions that steps are made of, in the order of their first calls
    const Function* function_ = nullptr;
    std::uint32_t in_place_of_ = 0;                     ///< Program::in_place_of of the steps that are made
    std::uint32_t line_ = 0, block_ = 0, maker_ = none; ///< maker_: id that the last step made
    bool is_stated_ = false;                            ///< Program::stated of the steps that are made
    std::uint32_t merge_ = none;                        ///< label behind what the next branch parts; none: a loop's
    bool begins_loop_ = false;                          ///< the block does
    std::set<std::uint32_t> loop_ends_;                 ///< labels behind loops
};

} // namespace lockstep::text
