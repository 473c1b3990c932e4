#include "gpu/record_buffer.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstring>
#include <memory>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "gpu/check.hpp"
#include "reference/model/error.hpp"

namespace lockstep {

/// Memory of the host that the GPU copies a slice into, while another slice is worked on. Where it is mapped itself, a
/// driver keeps a buffer in the host's memory from then on, and kernels work across the bus.
class StagedSlice {
  public:
    explicit StagedSlice(std::size_t bytes) {
        constexpr GLbitfield access = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
        gl::BindBuffer(GL_COPY_WRITE_BUFFER, buffer_.id());
        gl::BufferStorage(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr,
                          access | GL_CLIENT_STORAGE_BIT);
        memory_ = static_cast<const std::byte*>(
            gl::MapBufferRange(GL_COPY_WRITE_BUFFER, 0, static_cast<GLsizeiptr>(bytes), access));
    }
    [[nodiscard]] bool is_mapped() const { return memory_ != nullptr; }

    /// Begins to copy `bytes` of a buffer, from byte `from` on.
    void begin(const RecordBuffer& buffer, std::size_t from, std::size_t bytes) {
        gl::BindBuffer(GL_COPY_READ_BUFFER, buffer.id());
        gl::BindBuffer(GL_COPY_WRITE_BUFFER, buffer_.id());
        gl::CopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(from), 0,
                              static_cast<GLsizeiptr>(bytes));
        copied_ = gl::FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
        gl::Flush();
    }
    /// What was copied; waits for it.
    const std::byte* end() {
        while (gl::ClientWaitSync(copied_, GL_SYNC_FLUSH_COMMANDS_BIT, 1'000'000'000) == GL_TIMEOUT_EXPIRED) {
        }
        gl::DeleteSync(copied_);
        return memory_;
    }

  private:
    GlBuffer buffer_;
    const std::byte* memory_ = nullptr;
    GLsync copied_ = nullptr;
};

/// One is copied into while the other is worked on.
struct StagedSlices {
    explicit StagedSlices(std::size_t bytes) : slice{StagedSlice(bytes), StagedSlice(bytes)} {}
    [[nodiscard]] bool are_mapped() const { return slice[0].is_mapped() && slice[1].is_mapped(); }

    std::array<StagedSlice, 2> slice;
};

namespace {

/// Calls `work` with the buffer's memory, to read. A driver may lose a mapped buffer's contents (GL_FALSE at
/// unmapping); there is no telling what it holds then, hence the Error.
template <class Work> void with_mapped(const RecordBuffer& buffer, const Work& work) {
    const std::size_t bytes = buffer.size() * buffer.layout().bytes();
    const std::string& item = buffer.layout().about().item;
    gl::BindBuffer(GL_COPY_READ_BUFFER, buffer.id());
    const void* memory = gl::MapBufferRange(GL_COPY_READ_BUFFER, 0, static_cast<GLsizeiptr>(bytes), GL_MAP_READ_BIT);
    if (memory == nullptr) {
        check_gl(fmt::format("{} buffer", item));
        throw Error(fmt::format("{} buffer: GL cannot map it", item));
    }
    work(static_cast<const std::byte*>(memory));
    gl::BindBuffer(GL_COPY_READ_BUFFER, buffer.id()); // `work` may have mapped another
    if (gl::UnmapBuffer(GL_COPY_READ_BUFFER) == GL_FALSE)
        throw Error(fmt::format("{} buffer: its contents were lost while mapped", item));
}

constexpr std::size_t staged_bytes = std::size_t{8} << 20U; ///< of a slice that is read

/// Calls `work(memory, first record, records)` with the buffer's memory, a slice after the other.
template <class Work>
void with_slices(const RecordBuffer& buffer, std::unique_ptr<StagedSlices>& staged, const Work& work) {
    const std::size_t bytes = buffer.layout().bytes(), slice = std::max<std::size_t>(1, staged_bytes / bytes);
    if (buffer.size() > 2 * slice && gl::BufferStorage != nullptr) {
        if (staged == nullptr)
            staged = std::make_unique<StagedSlices>(slice * bytes);
        if (staged->are_mapped()) {
            const auto count = [&](std::size_t first) { return std::min(slice, buffer.size() - first); };
            const auto begin = [&](std::size_t first) {
                if (first < buffer.size())
                    staged->slice[first / slice % 2].begin(buffer, first * bytes, count(first) * bytes);
            };
            begin(0);
            for (std::size_t first = 0; first < buffer.size(); first += slice) {
                begin(first + slice);
                work(staged->slice[first / slice % 2].end(), first, count(first));
            }
            return;
        }
    }
    with_mapped(buffer, [&](const std::byte* records) { work(records, 0, buffer.size()); });
}

/// The same of several: `work` gets the memory of each.
template <class Work> void with_all_mapped(std::span<const RecordBuffer* const> buffers, const Work& work,
                                           std::vector<const std::byte*> memory = {}) {
    if (memory.size() == buffers.size())
        return work(std::span<const std::byte* const>(memory));
    with_mapped(*buffers[memory.size()], [&](const std::byte* records) {
        std::vector<const std::byte*> more = memory;
        more.push_back(records);
        with_all_mapped(buffers, work, std::move(more));
    });
}

constexpr std::size_t word = sizeof(std::uint32_t);
constexpr std::size_t slice_bytes = std::size_t{16} << 20U; ///< of an upload at once
constexpr std::size_t most_bytes = 256 * 4 * word;          ///< of a record: what a schema can have

/// Copies `count` values of `Words` words, which lie `from_stride` and are to lie `to_stride` bytes apart.
template <std::size_t Words> void copy_values(const std::byte* from, std::size_t from_stride, std::byte* to,
                                              std::size_t to_stride, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
        std::memcpy(to + i * to_stride, from + i * from_stride, Words * word);
}

void copy_values(std::size_t words, const std::byte* from, std::size_t from_stride, std::byte* to,
                 std::size_t to_stride, std::size_t count) {
    switch (words) {
    case 1:
        return copy_values<1>(from, from_stride, to, to_stride, count);
    case 2:
        return copy_values<2>(from, from_stride, to, to_stride, count);
    case 3:
        return copy_values<3>(from, from_stride, to, to_stride, count);
    default:
        return copy_values<4>(from, from_stride, to, to_stride, count);
    }
}

template <class Bits> Bits bits_at(const std::byte* memory) {
    Bits bits = 0;
    std::memcpy(&bits, memory, sizeof bits);
    return bits;
}

/// The bits in which `count` values of `Words` words differ from records' members, which lie `stride` bytes apart.
template <std::size_t Words>
std::uint64_t unlike(const std::byte* members, std::size_t stride, const std::byte* values, std::size_t count) {
    std::uint64_t found = 0;
    for (std::size_t i = 0; i < count; ++i, members += stride, values += Words * word) {
        for (std::size_t w = 0; w + 1 < Words; w += 2)
            found |= bits_at<std::uint64_t>(members + w * word) ^ bits_at<std::uint64_t>(values + w * word);
        if constexpr (Words % 2 == 1)
            found |= bits_at<std::uint32_t>(members + (Words - 1) * word) ^
                     bits_at<std::uint32_t>(values + (Words - 1) * word);
    }
    return found;
}

bool are_alike(std::size_t words, const std::byte* members, std::size_t stride, const std::byte* values,
               std::size_t count) {
    switch (words) {
    case 1:
        return unlike<1>(members, stride, values, count) == 0;
    case 2:
        return unlike<2>(members, stride, values, count) == 0;
    case 3:
        return unlike<3>(members, stride, values, count) == 0;
    default:
        return unlike<4>(members, stride, values, count) == 0;
    }
}

bool has_nan(const std::byte* floats, std::size_t count) {
    std::uint32_t found = 0;
#pragma omp simd reduction(| : found)
    for (std::size_t i = 0; i < count; ++i)
        found |= static_cast<std::uint32_t>((bits_at<std::int32_t>(floats + i * word) & 0x7fffffff) > 0x7f800000);
    return found != 0;
}

/// Some records, on their way: GL's memory is touched in order, and once.
class Block {
  public:
    explicit Block(const RecordLayout& layout)
        : layout_(layout), bytes_(layout.bytes()), room_(std::max<std::size_t>(1, most_bytes * 2 / bytes_)),
          records_(room_ * bytes_) {}

    [[nodiscard]] std::size_t room() const { return room_; } ///< records
    [[nodiscard]] std::byte* records() { return records_.data(); }

    void gather(const View& state, std::size_t first, std::size_t count) {
        for_each_member([&](std::uint8_t field, std::size_t words, std::size_t offset) {
            copy_values(words, state.columns[field] + first * words * word, words * word, records() + offset, bytes_,
                        count);
        });
    }

    /// Whether `count` records have the values of those here. Words between members are anything.
    [[nodiscard]] bool is_like(const std::byte* records, std::size_t count) const {
        if (!layout_.has_gaps())
            return std::memcmp(records, records_.data(), count * bytes_) == 0;
        bool same = true;
        for_each_member([&](std::uint8_t /*field*/, std::size_t words, std::size_t offset) {
            for (std::size_t i = 0; i < count && same; ++i)
                same = std::memcmp(records + i * bytes_ + offset, records_.data() + i * bytes_ + offset,
                                   words * word) == 0;
        });
        return same;
    }

    void scatter(const WritableView& state, std::size_t first, std::size_t count) {
        for_each_member([&](std::uint8_t field, std::size_t words, std::size_t offset) {
            copy_values(words, records() + offset, bytes_, state.columns[field] + first * words * word, words * word,
                        count);
        });
    }

  private:
    template <class Work> void for_each_member(const Work& work) const {
        layout_.for_each_member([&](const RecordLayout::Member& member, std::size_t first) {
            work(member.field, static_cast<std::size_t>(layout_.field(member).components), first * word);
        });
    }

    const RecordLayout& layout_;
    std::size_t bytes_;
    std::size_t room_;
    std::vector<std::byte> records_;
};

/// Calls `work(block, first record, records)` until all `count` are through.
template <class Work> void in_blocks(const RecordLayout& layout, std::size_t count, const Work& work) {
#pragma omp parallel if (count > 1024)
    {
        Block block(layout);
        const auto blocks = static_cast<std::ptrdiff_t>((count + block.room() - 1) / block.room());
#pragma omp for schedule(static)
        for (std::ptrdiff_t b = 0; b < blocks; ++b) {
            const std::size_t first = static_cast<std::size_t>(b) * block.room();
            work(block, first, std::min(block.room(), count - first));
        }
    }
}

} // namespace

bool RecordLayout::has(FieldId id) const {
    return id.resource == resource &&
           std::ranges::any_of(members, [&](const Member& member) { return member.field == id.field; });
}

bool RecordLayout::has_gaps() const {
    std::size_t filled = 0;
    for (const Member& member : members)
        filled += static_cast<std::size_t>(field(member).components);
    return filled != words();
}

std::size_t RecordLayout::words() const {
    std::size_t words = 0;
    for_each_member([&](const Member& member, std::size_t first) {
        words = std::max(words, first + static_cast<std::size_t>(field(member).components));
    });
    return about().record_words.value_or(static_cast<std::uint32_t>(words));
}

std::vector<Capture> RecordLayout::captures() const {
    std::vector<Capture> captures;
    for (const Member& member : members)
        captures.push_back({"out_" + member.name, gl_type(field(member))});
    return captures;
}

GLenum gl_type(const Field& field) {
    constexpr GLenum types[3][4] = {
        {GL_FLOAT, GL_FLOAT_VEC2, GL_FLOAT_VEC3, GL_FLOAT_VEC4},
        {GL_INT, GL_INT_VEC2, GL_INT_VEC3, GL_INT_VEC4},
        {GL_UNSIGNED_INT, GL_UNSIGNED_INT_VEC2, GL_UNSIGNED_INT_VEC3, GL_UNSIGNED_INT_VEC4}};
    return types[static_cast<std::size_t>(field.scalar)][field.components - 1];
}

RecordBuffer::RecordBuffer(RecordBuffer&&) noexcept = default;
RecordBuffer& RecordBuffer::operator=(RecordBuffer&&) noexcept = default;
RecordBuffer::~RecordBuffer() = default;

RecordBuffer::RecordBuffer(const RecordLayout& layout, std::size_t count, std::size_t spare)
    : layout_(&layout), count_(count), spare_(spare) {
    gl::BindBuffer(GL_COPY_READ_BUFFER, buffer_.id());
    gl::BufferData(GL_COPY_READ_BUFFER, static_cast<GLsizeiptr>((count + spare) * layout.bytes()), nullptr,
                   GL_DYNAMIC_COPY);
    check_gl(fmt::format("buffer of {} {}s", count, layout.about().item));
    if (spare > 0)
        lay(range("").margin);
}

void RecordBuffer::upload(const View& state) {
    assert(state.count() == count_);
    if (count_ == 0)
        return;
    // Not mapped, like a slice that is read.
    const std::size_t slice = std::clamp<std::size_t>(slice_bytes / layout_->bytes(), 1, count_);
    std::vector<std::byte> records(slice * layout_->bytes());
    gl::BindBuffer(GL_COPY_READ_BUFFER, buffer_.id());
    for (std::size_t from = 0; from < count_; from += slice) {
        const std::size_t some = std::min(slice, count_ - from);
        in_blocks(*layout_, some, [&](Block& block, std::size_t first, std::size_t count) {
            block.gather(state, from + first, count);
            std::memcpy(records.data() + first * layout_->bytes(), block.records(), count * layout_->bytes());
        });
        gl::BufferSubData(GL_COPY_READ_BUFFER, static_cast<GLintptr>(from * layout_->bytes()),
                          static_cast<GLsizeiptr>(some * layout_->bytes()), records.data());
    }
    check_gl(fmt::format("upload of {}s", layout_->about().item));
}

void RecordBuffer::read(const WritableView& state) const {
    assert(state.count() == count_);
    if (count_ == 0)
        return;
    with_slices(*this, staged_, [&](const std::byte* records, std::size_t from, std::size_t some) {
        in_blocks(*layout_, some, [&](Block& block, std::size_t first, std::size_t count) {
            std::memcpy(block.records(), records + first * layout_->bytes(), count * layout_->bytes());
            block.scatter(state, from + first, count);
        });
    });
}

bool RecordBuffer::holds(const View& state) const {
    assert(state.count() == count_);
    std::atomic<bool> same = true;
    if (count_ == 0)
        return same;
    with_slices(*this, staged_, [&](const std::byte* records, std::size_t from, std::size_t some) {
        in_blocks(*layout_, some, [&](Block& block, std::size_t first, std::size_t count) {
            block.gather(state, from + first, count);
            if (!block.is_like(records + first * layout_->bytes(), count))
                same = false;
        });
    });
    return same;
}

namespace {

/// Whether a buffer's records `first` to `last`, the last excluded, are a state's, and no float of them is NaN.
bool holds_numbers(const RecordLayout& layout, const std::byte* memory, const View& state, std::size_t first,
                   std::size_t last) {
    constexpr std::size_t some = 64; // of the nearest cache: each member comes by them once more
    const std::size_t bytes = layout.bytes();
    for (; first < last; first += some) {
        const std::size_t count = std::min(some, last - first);
        bool same = true;
        layout.for_each_member([&](const RecordLayout::Member& member, std::size_t place) {
            const Field& field = layout.field(member);
            const auto words = static_cast<std::size_t>(field.components);
            const std::byte* const column = state.columns[member.field];
            const std::byte* const values = column + first * words * word;
            same = same && (column == nullptr ||
                            (are_alike(words, memory + first * bytes + place * word, bytes, values, count) &&
                             (field.scalar != Scalar::float32 || !has_nan(values, count * words))));
        });
        if (!same)
            return false;
    }
    return true;
}

} // namespace

bool hold_numbers(std::span<const RecordBuffer* const> buffers, const View& state) {
    if (state.count() == 0)
        return true;
    std::atomic<bool> same = true;
    with_all_mapped(buffers, [&](std::span<const std::byte* const> memory) {
        // One loop over all of them: at the end of each every thread waits.
        constexpr std::size_t range = 1024;
        const auto ranges = static_cast<std::ptrdiff_t>((state.count() + range - 1) / range);
#pragma omp parallel for schedule(dynamic) if (ranges > 1)
        for (std::ptrdiff_t r = 0; r < ranges; ++r) {
            const std::size_t from = static_cast<std::size_t>(r) * range, to = std::min(from + range, state.count());
            for (std::size_t b = 0; b < buffers.size() && same.load(std::memory_order_relaxed); ++b)
                if (!holds_numbers(buffers[b]->layout(), memory[b], state, from, to))
                    same = false;
        }
    });
    return same;
}

void RecordBuffer::fill(std::uint32_t pattern) {
    const std::size_t bytes = count_ * layout_->bytes();
    const std::vector<std::uint32_t> words(std::min(bytes, slice_bytes) / word, pattern);
    gl::BindBuffer(GL_COPY_READ_BUFFER, buffer_.id());
    for (std::size_t from = 0; from < bytes; from += slice_bytes)
        gl::BufferSubData(GL_COPY_READ_BUFFER, static_cast<GLintptr>(from),
                          static_cast<GLsizeiptr>(std::min(slice_bytes, bytes - from)), words.data());
}

void RecordBuffer::copy(const RecordBuffer& other) {
    assert(other.count_ == count_ && other.layout_->bytes() == layout_->bytes());
    gl::BindBuffer(GL_COPY_READ_BUFFER, other.id());
    gl::BindBuffer(GL_COPY_WRITE_BUFFER, id());
    gl::CopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0, 0,
                          static_cast<GLsizeiptr>(count_ * layout_->bytes()));
}

StorageRange RecordBuffer::range(std::string block) const {
    const std::size_t bytes = layout_->bytes();
    return {std::move(block), layout_->about().item, count_, bytes, {id(), count_ * bytes, spare_ * bytes}};
}

std::array<std::uint32_t, 3> RecordBuffer::three_words(std::size_t place) const {
    std::array<std::uint32_t, 3> words{};
    gl::BindBuffer(GL_COPY_READ_BUFFER, buffer_.id());
    gl::GetBufferSubData(GL_COPY_READ_BUFFER, static_cast<GLintptr>(place), static_cast<GLsizeiptr>(sizeof words),
                         words.data());
    return words;
}

void RecordBuffer::bind_capture() const { gl::BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, id()); }

namespace {

/// Into the vertex array that is bound. `divisor`: 0 a vertex a record, 1 an instance.
void feed(const RecordBuffer& buffer, const Program& program, GLuint divisor) {
    gl::BindBuffer(GL_ARRAY_BUFFER, buffer.id());
    const RecordLayout& layout = buffer.layout();
    const auto stride = static_cast<GLsizei>(layout.bytes());
    layout.for_each_member([&](const RecordLayout::Member& member, std::size_t first) {
        const Field& field = layout.field(member);
        const GLint found = program.attribute("a_" + member.name, gl_type(field));
        const auto* const start = reinterpret_cast<const void*>(first * word);
        if (found < 0)
            return;
        const auto location = static_cast<GLuint>(found);
        gl::EnableVertexAttribArray(location);
        if (field.scalar == Scalar::float32)
            gl::VertexAttribPointer(location, field.components, GL_FLOAT, GL_FALSE, stride, start);
        else
            gl::VertexAttribIPointer(location, field.components,
                                     field.scalar == Scalar::int32 ? GL_INT : GL_UNSIGNED_INT, stride, start);
        gl::VertexAttribDivisor(location, divisor);
    });
}

} // namespace

GlVertexArray vertex_array(const RecordBuffer& buffer, const Program& program) {
    GlVertexArray array;
    gl::BindVertexArray(array.id());
    feed(buffer, program, 0);
    gl::BindVertexArray(0);
    return array;
}

GlVertexArray instance_array(std::span<const RecordBuffer* const> buffers, const Program& program) {
    GlVertexArray array;
    gl::BindVertexArray(array.id());
    for (const RecordBuffer* const buffer : buffers)
        feed(*buffer, program, 1);
    gl::BindVertexArray(0);
    return array;
}

} // namespace lockstep
