#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "gpu/shader_source.hpp"
#include "reference/model/schema.hpp"
#include "reference/text/accesses.hpp"
#include "reference/text/program.hpp"

namespace lockstep::check_file {

/// A shader as lockstep reads it.
struct ShaderText {
    text::Program program;
    text::Accesses accesses;
    std::string file; ///< for messages
};

/// Throws Error as load_stages and program_of do.
ShaderText shader_text(const ShaderFolders& folders, const std::string& name, Stage stage);

/// A buffer's record, as a shader declares it.
struct Record {
    std::vector<Field> fields; ///< with their places
    std::uint32_t words = 0;   ///< from one to the next
    std::uint32_t count = 0;   ///< as many as there are; 0: as many as the buffer has
    std::string declared;      ///< where, for messages

    /// Whether it has the same types in the same places.
    [[nodiscard]] bool is_like(const Record& other) const;
};

/// Of a block that is one array, or has no array without a size: then it is one record. No fields of another. Columns
/// of matrices and elements of arrays are fields by themselves: m_0, m_1.
Record record_of(const text::Block& block, const std::string& file);

} // namespace lockstep::check_file
