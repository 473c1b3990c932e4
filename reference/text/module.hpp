#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <spirv.hpp>

/// A shader's own text as a reference: SPIR-V modules (SPIR-V 1.6), decoded once and interpreted over a reading.
namespace lockstep::text {

/// The place of a line of the text that was compiled, as FILE:LINE; lines count from 1.
using LineName = std::function<std::string(std::uint32_t line)>;

/// How an image's texels lie.
struct ImageShape {
    spv::Dim dimensions = spv::Dim2D;
    bool is_arrayed = false, has_samples = false;
    spv::ImageFormat format = spv::ImageFormatUnknown; ///< of an image that is stored to, as its layout says

    /// Numbers of a texel's place: along its dimensions, a cube's face, a layer, a sample.
    [[nodiscard]] std::uint32_t axes() const {
        const bool is_line = dimensions == spv::Dim1D || dimensions == spv::DimBuffer;
        return (is_line ? 1U : dimensions == spv::Dim2D ? 2U : 3U) + (is_arrayed ? 1U : 0U) + (has_samples ? 1U : 0U);
    }
};

/// A type of the module (SPIR-V 3.42.6).
struct Type {
    enum class Kind : std::uint8_t {
        nothing,
        boolean,
        integer,
        real,
        vector,
        matrix,
        array,
        structure,
        pointer,
        image,
        sampled_image,
        sampler, ///< without its image
        function
    };
    struct Member {
        std::uint32_t type = 0, offset = 0, matrix_stride = 0; ///< bytes
        bool is_row_major = false, is_flat = false, is_coherent = false;
        std::optional<spv::BuiltIn> builtin = {};
        std::optional<std::uint32_t> location = {};
        std::string name = {};
    };

    Kind kind = Kind::nothing;
    bool is_signed = false;    ///< of integers
    std::uint32_t element = 0; ///< type of what it is made of or points to; the component's of an image
    std::uint32_t count = 0;   ///< of elements; 0 of an array: as many as its buffer has
    std::uint32_t stride = 0;  ///< of an array in a block, bytes
    std::uint32_t cells = 0;   ///< scalars of a value
    spv::StorageClass storage = spv::StorageClassFunction; ///< of pointers
    ImageShape shape;                                      ///< of images
    bool is_storage = false;                               ///< of images: no sampler
    std::vector<Member> members;                           ///< of structures
    std::string name;
};

/// What decorations and debug instructions say of an id.
struct IdInfo {
    std::string name;
    std::uint32_t type = 0;
    std::optional<spv::BuiltIn> builtin;
    std::optional<std::uint32_t> location;
    std::optional<std::uint32_t> binding, set;
    bool is_precise = false; ///< NoContraction
    bool is_block = false, is_buffer_block = false, is_flat = false, is_coherent = false;
};

/// A value known before the shader runs.
struct Constant {
    std::uint32_t id = 0, type = 0;
    std::vector<std::uint32_t> words; ///< one a scalar
    bool is_undefined = false;        ///< OpUndef
};

struct Variable {
    std::uint32_t id = 0, type = 0; ///< type of what it holds
    spv::StorageClass storage = spv::StorageClassFunction;
    std::uint32_t initializer = 0; ///< id of a constant, or of a value of its function; 0: none
};

struct Instruction {
    spv::Op op = spv::OpNop;
    std::uint32_t line = 0, result = 0;   ///< result: id of a value that it makes; 0: it makes none
    bool has_line = false;                ///< its block says the line; else it is that of a block before
    std::span<const std::uint32_t> words; ///< operands
};

struct Function {
    std::uint32_t id = 0, result = 0; ///< type of its result
    std::vector<std::uint32_t> parameters;
    std::vector<Instruction> body;
};

/// What a module declares, and its functions as they stand.
struct Module {
    std::vector<std::uint32_t> words;
    std::vector<Type> types; ///< by id
    std::vector<IdInfo> ids; ///< by id
    std::vector<Constant> constants;
    std::vector<Variable> variables; ///< outside functions
    std::vector<Function> functions;
    std::uint32_t entry = 0, extension = 0; ///< ids of the entry point and of GLSL.std.450
    spv::ExecutionModel stage = spv::ExecutionModelGLCompute;
    std::array<std::uint32_t, 3> group{1, 1, 1};
    std::uint32_t most_vertices = 0;                  ///< that an invocation of a geometry stage emits
    bool are_quads = false, are_square_quads = false; ///< of a compute stage whose invocations are neighbours
    LineName line_name;

    [[nodiscard]] const Type& type_of(std::uint32_t id) const { return types[ids[id].type]; }
    /// The kind of the scalars that a type is made of.
    [[nodiscard]] const Type& scalar_of(std::uint32_t type) const;
    [[nodiscard]] const Constant* constant(std::uint32_t id) const;
    /// Throws Error "shader FILE:LINE: ...".
    [[noreturn]] void refuse(std::uint32_t line, std::string_view what) const;

  private:
    friend class ModuleReader;
    std::vector<std::uint32_t> constant_of_; ///< by id: place, from 1
};

/// Throws Error for what is no module, and naming by FILE:LINE what is not interpreted.
Module read_module(std::vector<std::uint32_t> words, LineName line_name);

} // namespace lockstep::text
