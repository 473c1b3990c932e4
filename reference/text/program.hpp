#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reference/text/module.hpp"

namespace lockstep::text {

/// Codes of steps. Below `extended` they are SPIR-V's opcodes; from there on GLSL.std.450's instructions; from `own` on
/// what SPIR-V has in another form.
namespace code {
inline constexpr std::uint16_t extended = 512;
inline constexpr std::uint16_t own = 1024;
enum Own : std::uint16_t {
    copy = own,    ///< n cells from a to out
    address,       ///< out = c + sum over n of (cell, stride, count) at d: an offset
    load_variable, ///< n cells from cell (a + offset at b)
    store_variable,
    load_shared, ///< n cells from offset at b
    store_shared,
    load_block, ///< of block a, from offset at b; d: leaves
    store_block,
    atomic_shared, ///< SPIR-V opcode n on offset at b: operand c, comparator d; out: the value before, or no_cell
    atomic_block,  ///< the same of block a
    atomic_texel,  ///< the same of image a's texel at b
    array_length,  ///< of block a
    image_size,    ///< of the image in cell a
    query_levels,
    load_texel,   ///< n components of image in cell a at b, of c axes; by imageLoad
    fetch_texel,  ///< the same by texelFetch
    store_texel,  ///< n components from c into image in cell a at b, of d axes
    sample_texel, ///< n components of image in cell a at b, of c axes, moved by the texels at d, or no_cell
    real_bits,    ///< n cells from a, floats to words
    bits_as_real, ///< n cells from a, words to floats
    jump,         ///< to a
    branch,       ///< on cell a to b, else c
    choose,       ///< OpSwitch on cell a; default b; n pairs of literal and step at d
    from_block,   ///< OpPhi of n cells: a pairs of block and cell at d; b: how many follow it
    leave_block,  ///< sets the block that lanes come from to a
    call,         ///< goes on at a, returns to the next step
    finish,       ///< returns, or ends the invocation
    fence,        ///< a memory barrier of semantics a
    barrier,      ///< the same, for all of a group
    stages,       ///< from here on steps of other stages than compute
    discard = stages,
    emit_vertex,
    end_primitive,
    differ_x, ///< n cells from a: by how much those of the quad's right neighbour are larger
    differ_y, ///< of its upper neighbour
    differ_both
};
} // namespace code

/// In the place of a cell's number: there is none.
inline constexpr std::uint32_t no_cell = 0xffffffffU;

/// One operation on all components of its operands. Cells hold scalars; each result has cells of its own, since GLSL
/// has no recursion (GLSL 4.60, 6.1).
struct Step {
    std::uint16_t op = 0;
    std::uint16_t n = 0; ///< components
    std::uint32_t out = 0, a = 0, b = 0, c = 0, d = 0;
};

/// Blocks and variables are held in words of 32 bits.
inline constexpr std::uint32_t word_bytes = 4;

/// A scalar of a value in a block.
struct Leaf {
    std::uint32_t word = 0; ///< from the value's first
    bool is_real = false;
};

/// A scalar, vector or matrix, or an array of such.
struct BasicType {
    bool is_real = true, is_boolean = false, is_signed = false;
    std::uint32_t rows = 1, columns = 1;
    std::uint32_t elements = 0; ///< of an array; 0: it is none
};

/// Where the text binds a block or an image. The elements of an array of them are told apart: by modules GL, which
/// gives each a number of its own, and Vulkan, which gives them one, are alike.
struct Binding {
    std::uint32_t set = 0, number = 0, element = 0;
    bool operator==(const Binding&) const = default;
};

/// A storage or uniform block, push constants, or an atomic counter.
struct Block {
    /// By its name in GL, as plain uniforms have it.
    struct Member {
        std::string name;
        std::vector<Leaf> leaves;
        BasicType type = {};
    };
    std::string name; ///< of the block, not of its instance; an atomic counter's own
    bool is_storage = true;
    /// Of an array without a length at its end, bytes; stride 0: there is none.
    std::uint32_t array_offset = 0, array_stride = 0;
    std::vector<Leaf> leaves = {}, element = {}; ///< scalars before that array, and of one of its elements
    std::vector<Member> members = {};            ///< before that array
    std::vector<Member> element_members = {};    ///< of one of its elements
    /// Of a block that is one array: words from one element to the next, how many there are (0: as many as its buffer
    /// has), and what one is made of.
    struct Records {
        std::uint32_t words = 0, count = 0;
        std::vector<Member> members = {};
    };
    std::optional<Records> records = {};
    std::optional<Binding> binding = {}; ///< that the text gives it
    /// First words of members that are not `coherent` or `volatile`, and of those that are, in their order.
    struct Coherence {
        std::uint32_t word = 0;
        bool is_coherent = false;
    };
    std::vector<Coherence> coherence = {};

    /// Words of the block whose array has `count` elements.
    [[nodiscard]] std::size_t words(std::size_t count) const;
    [[nodiscard]] bool is_coherent(std::uint32_t word) const;
};

/// A plain uniform, or a member of one, by its name in GL: light.colour, weights[0].
struct PlainUniform {
    std::string name;
    std::uint32_t cell = 0, cells = 0; ///< elements of an array of basic types together
    bool is_real = true, is_boolean = false;
    BasicType type = {};
};

/// A uniform that is an image or a sampler. Its cell holds its number.
struct ImageUniform {
    std::string name;
    bool is_storage = false;
    ImageShape shape;
    bool is_real = true; ///< components are floats
    bool is_signed = false;
    bool is_coherent = false;
    std::optional<Binding> binding = {}; ///< that the text gives it
};

/// An input or output of a vertex, geometry or fragment stage: a variable, or a member of a block or structure.
struct StageVariable {
    std::string name;     ///< in GL: v_Colour, Block.normal, lights[0].colour, gl_Position
    std::string instance; ///< by which the text calls the block; empty: none
    std::optional<std::uint32_t> location = {};
    std::optional<spv::BuiltIn> builtin = {};
    std::uint32_t variable = 0;        ///< first cell of the variable that it is a member of
    std::uint32_t cell = 0, cells = 0; ///< elements of an array of basic types together
    std::uint32_t components = 1;      ///< of an element, or a column
    /// Of an input of a geometry stage: how many vertices have one, and how many cells lie from one's to the next's.
    std::uint32_t vertices = 1, stride = 0;
    bool is_real = true, is_boolean = false, is_flat = false;
    bool is_read = false; ///< an input that some step reads

    [[nodiscard]] std::uint32_t words() const { return cells * vertices; } ///< of an invocation
};

/// A variable of the text.
struct NamedCells {
    /// A scalar of it.
    struct Part {
        std::string name; ///< behind the variable's: .velocity.y, [3]; empty: it is the whole
        bool is_real = false, is_boolean = false, is_signed = false;
    };
    std::string name;
    std::uint32_t first = 0, count = 0;
    std::vector<Part> parts = {}; ///< empty of many
};

struct CellWord {
    std::uint32_t cell = 0, word = 0;
    bool is_real = false;
};

struct BuiltInInput {
    spv::BuiltIn builtin = spv::BuiltInGlobalInvocationId;
    std::uint32_t cell = 0, cells = 0;
};

/// A condition of the text by which invocations part, or a switch. Those of constants are none.
struct Decision {
    enum class Kind : std::uint8_t {
        condition, ///< of an `if`, or of a `?:` that leaves one side out
        loop,
        loop_again, ///< asked behind the loop's body
        left_of_and,
        left_of_or, ///< of its opposite
        cases
    };
    std::uint32_t step = 0, line = 0;
    Kind kind = Kind::condition;
    bool has_default = false, is_signed = false; ///< of a switch
};

/// A decoded shader.
struct Program {
    std::vector<Step> steps;
    std::shared_ptr<const Program> fewer; ///< the same in fewer steps (fewer_copies.hpp); null: there is none
    std::vector<std::uint32_t> lines;     ///< of each step
    std::vector<std::uint8_t> stated;     ///< of each step: the text has a statement there, in that line
    std::vector<std::uint8_t> precise;    ///< of each step: nothing fuses or reorders it (NoContraction)
    /// Of each step that a function's body makes in the place of its call: the call's number, from 1, in in_place; 0:
    /// none.
    std::vector<std::uint32_t> in_place_of;
    struct InPlaceCall {
        std::uint32_t line = 0, outer = 0; ///< of the call, and what it is itself in the place of
    };
    std::vector<InPlaceCall> in_place;
    std::vector<Decision> decisions;     ///< in the order of their steps
    std::vector<std::uint32_t> operands; ///< further ones of steps
    std::vector<Leaf> leaves;
    std::uint32_t cells = 0, shared = 0;         ///< how many
    std::uint32_t variables = 0;                 ///< how many of the first cells are variables without a value at first
    std::uint32_t scratch = 0;                   ///< four cells that last for a step
    std::vector<NamedCells> names, shared_names; ///< of these, and of shared variables
    std::vector<std::uint32_t> undefined;        ///< cells that OpUndef stands for
    std::vector<CellWord> constants;             ///< set once
    std::vector<CellWord> initial;               ///< of variables outside functions, set for each invocation
    std::vector<BuiltInInput> inputs;            ///< of a compute stage
    std::uint32_t entry = 0;                     ///< first step
    spv::ExecutionModel stage = spv::ExecutionModelGLCompute;
    std::array<std::uint32_t, 3> group{1, 1, 1};
    std::vector<StageVariable> stage_inputs, stage_outputs; ///< of other stages than compute
    std::uint32_t output_cells = 0;                         ///< the first cells are the outputs'
    std::vector<std::uint8_t> is_written;                   ///< by cell of an output: whether a step writes it
    std::uint32_t most_vertices = 0;                        ///< that an invocation of a geometry stage emits
    std::vector<Block> blocks;
    std::vector<PlainUniform> uniforms;
    std::vector<ImageUniform> images;
    std::vector<NamedCells> set_shared; ///< shared variables that begin as 0 (GL_EXT_null_initializer)
    std::uint32_t barriers = 0;
    /// The first line that asks for what is the driver's choice, and for what; 0: none does.
    std::uint32_t choice_line = 0;
    std::string_view choice;
    bool are_quads = false, are_square_quads = false; ///< of a compute stage: each four invocations, two by two
    LineName line_name;
    std::vector<std::uint8_t> counted; ///< by cell: of a variable whose name has counted_name; empty: there is none

    /// Whether what is stored in the cell counts as used.
    [[nodiscard]] bool is_counted(std::uint32_t cell) const { return cell < counted.size() && counted[cell] != 0; }
    /// "variable sum".
    [[nodiscard]] std::string variable_at(std::uint32_t cell) const;
    [[nodiscard]] std::string_view shared_at(std::uint32_t cell) const; ///< the shared variable's name
    [[nodiscard]] std::uint32_t invocations() const { return group[0] * group[1] * group[2]; }
};

/// Part of the names of variables that nothing reads, whose values are looked at all the same.
inline constexpr std::string_view counted_name = "lockstep_given";

/// A compute, vertex, geometry or fragment stage. Throws Error naming by FILE:LINE what is not interpreted.
Program decoded(const Module& module);

} // namespace lockstep::text
