#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reference/model/schema.hpp"

namespace lockstep {

/// A column of a table: numbers, or vectors of them.
struct TableColumn {
    std::string name;
    Scalar scalar = Scalar::float32;
    int components = 1; ///< to 4
    bool optional = false;
    bool is_bool = false; ///< an int32 that is 0 or 1, or written as false or true
};

/// Rows of numbers from a file.
struct NumberTable {
    std::string file;                              ///< as messages name it
    std::size_t rows = 0;                          ///< at least one
    std::vector<std::vector<std::uint32_t>> words; ///< of each column row after row, as bits; none where it is left out
    std::vector<std::size_t> lines;                ///< where each row stands, from 1; of JSON none
};

/// The bits of a number as a table writes it, rounded once; nothing for a text that is none of the column's.
std::optional<std::uint32_t> number_bits(std::string_view text, const TableColumn& column);

/// Words for a text that is no number of the column's: "no int; right is 7, -7 or 0x7".
std::string_view no_number(const TableColumn& column);

/// Reads FILE.json, an array of objects by the columns' names, or a CSV file with a heading, a component a column
/// (`velocity.x`); a line that begins with # is left out. A number is the float nearest to it; `inf`, `nan` and
/// hexadecimal floats (0x1.8p-3) and integers (0xff) are numbers, in JSON as texts. `taker`: who takes the columns, for
/// messages. Throws Error with FILE:LINE, or the place in the JSON, and what would be right.
NumberTable read_number_table(const std::filesystem::path& file, const std::vector<TableColumn>& columns,
                              const std::string& taker);

} // namespace lockstep
