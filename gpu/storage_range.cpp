#include "gpu/storage_range.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep {

void lay(const Margin& margin) {
    const std::vector<std::uint32_t> words(margin.bytes / sizeof(margin_word), margin_word);
    gl::BindBuffer(GL_COPY_READ_BUFFER, margin.buffer);
    gl::BufferSubData(GL_COPY_READ_BUFFER, static_cast<GLintptr>(margin.from),
                      static_cast<GLsizeiptr>(words.size() * sizeof(margin_word)), words.data());
}

std::optional<std::size_t> first_written(const Margin& margin) {
    if (margin.bytes == 0)
        return {};
    // By a copy: a driver may move a buffer that is read itself to where kernels are slow.
    std::vector<std::uint32_t> words(margin.bytes / sizeof(margin_word));
    const auto bytes = static_cast<GLsizeiptr>(words.size() * sizeof(margin_word));
    const GlBuffer copy;
    gl::BindBuffer(GL_COPY_READ_BUFFER, margin.buffer);
    gl::BindBuffer(GL_COPY_WRITE_BUFFER, copy.id());
    gl::BufferData(GL_COPY_WRITE_BUFFER, bytes, nullptr, GL_STREAM_READ);
    gl::CopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(margin.from), 0, bytes);
    gl::GetBufferSubData(GL_COPY_WRITE_BUFFER, 0, bytes, words.data());
    const auto written = std::find_if(words.begin(), words.end(), [](std::uint32_t one) { return one != margin_word; });
    if (written == words.end())
        return {};
    return static_cast<std::size_t>(written - words.begin()) * sizeof(margin_word);
}

std::size_t largest_group() {
    if (!gl::offers(4, 3))
        return 0;
    GLint most = 0;
    gl::GetIntegerv(GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS, &most);
    return static_cast<std::size_t>(most);
}

void StorageRange::bind(GLuint point, bool ends_with_last) const {
    if (ends_with_last && count > 0)
        gl::BindBufferRange(GL_SHADER_STORAGE_BUFFER, point, margin.buffer, 0,
                            static_cast<GLsizeiptr>(count * item_bytes));
    else
        gl::BindBufferBase(GL_SHADER_STORAGE_BUFFER, point, margin.buffer);
}

std::string past_end_text(const Program& program, const StorageRange& range, std::size_t item) {
    return fmt::format("{} ({}) wrote past the end of {} ({} {}{}), at item {}; expected no write from item {} on",
                       program.name(), program.file(), range.block, range.count, range.item,
                       range.count == 1 ? "" : "s", item, range.count);
}

void check_margin(const Program& program, const StorageRange& range, std::string_view when) {
    if (const std::optional<std::size_t> byte = first_written(range.margin))
        throw Error(fmt::format("{}{}", when, past_end_text(program, range, range.count + *byte / range.item_bytes)));
}

void StorageBuffer::allocate(StorageRange items, std::size_t spare, const void* memory, GLenum usage) {
    range_ = std::move(items);
    const std::size_t bytes = range_.count * range_.item_bytes;
    range_.margin = {buffer_.id(), bytes, std::max<std::size_t>(1, spare) * range_.item_bytes};
    gl::BindBuffer(GL_SHADER_STORAGE_BUFFER, buffer_.id());
    gl::BufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(bytes + range_.margin.bytes), nullptr, usage);
    if (memory != nullptr)
        gl::BufferSubData(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(bytes), memory);
    lay(range_.margin);
}

} // namespace lockstep
