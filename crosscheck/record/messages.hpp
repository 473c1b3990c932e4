#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "crosscheck/files/plain_text.hpp"
#include "reference/model/error.hpp"

namespace lockstep {

/// What the process that reads a recording tells the one that asked for it (reading_process.hpp). Nothing of it is
/// trusted: the reading process may have been taken over by the file it reads.
enum class MessageKind : std::uint32_t {
    error,         ///< a text
    contents,      ///< JSON: sizes, texts and warnings
    positions,     ///< of the obstacles' corners
    triangles,     ///< their indices
    reciprocals,   ///< int8, root_offsets.hpp
    inverse_sqrts, ///< int8
    particles,     ///< one row: all values of the first field, then of the second, and so on
    cdt,           ///< one frame
    row,           ///< of a buffer or image: all values of the first field, then of the second, and so on
    frames,        ///< of each of its rows, int32
    passes,        ///< likewise
};

/// Comes before every message's bytes.
struct MessageHead {
    MessageKind kind = MessageKind::error;
    std::uint32_t index = 0; ///< row or frame
    std::uint64_t bytes = 0;
};

/// Which states are wanted.
struct Request {
    MessageKind kind = MessageKind::particles; ///< particles, cdt or row
    std::uint32_t index = 0;
    std::uint32_t resource = 0; ///< of a row
};

/// Where messages come from.
class ByteSource {
  public:
    ByteSource() = default;
    virtual ~ByteSource() = default;
    ByteSource(const ByteSource&) = delete;
    ByteSource& operator=(const ByteSource&) = delete;
    /// Fills `into`. Throws Error where there are no more bytes.
    virtual void read(void* into, std::size_t bytes) = 0;
};

/// Reads the messages of one recording in the order they have to come.
class Messages {
  public:
    /// `file`: named in errors.
    Messages(ByteSource& source, std::string file) : source_(source), file_(std::move(file)) {}

    [[noreturn]] void fail(const std::string& what) const { throw Error(fmt::format("{}: {}", file_, what)); }

    /// The size of the next message, which is to be of that kind.
    std::uint64_t expect(MessageKind kind, std::uint32_t index = 0) {
        MessageHead head;
        source_.read(&head, sizeof head);
        if (head.kind == MessageKind::error)
            fail(plain_line(text(head.bytes)));
        if (head.kind != kind || head.index != index)
            fail("its reading process broke: it answers what nobody asked");
        return head.bytes;
    }

    std::string text(std::uint64_t bytes) {
        if (bytes > longest_text)
            fail("its reading process broke: it sends a text without end");
        std::string text(bytes, '\0');
        source_.read(text.data(), bytes);
        return text;
    }

    /// All values of the next message; `most`: bytes.
    template <class Value> std::vector<Value> values(MessageKind kind, std::uint64_t most) {
        const std::uint64_t bytes = expect(kind);
        if (bytes > most || bytes % sizeof(Value) != 0)
            fail(fmt::format("its reading process broke: {} bytes where at most {} can be", bytes, most));
        std::vector<Value> all(bytes / sizeof(Value));
        source_.read(all.data(), bytes);
        return all;
    }

    template <class Value> void fill(std::vector<Value>& all) { source_.read(all.data(), all.size() * sizeof(Value)); }
    void fill(std::byte* bytes, std::size_t count) { source_.read(bytes, count); }

  private:
    static constexpr std::uint64_t longest_text = std::uint64_t{64} << 20U; ///< bytes

    ByteSource& source_;
    std::string file_;
};

} // namespace lockstep
