#include <cstddef>
#include <cstdint>
#include <cstring>

#include "crosscheck/collision/record/trace_messages.hpp"
#include "reference/model/error.hpp"

using namespace lockstep;

namespace {

class Bytes : public ByteSource {
  public:
    Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
    void read(void* into, std::size_t bytes) override {
        if (bytes > size_)
            throw Error("no more bytes");
        if (bytes > 0)
            std::memcpy(into, data_, bytes);
        data_ += bytes;
        size_ -= bytes;
    }

  private:
    const std::uint8_t* data_;
    std::size_t size_;
};

} // namespace

/// What the process that reads a trace may say, were it taken over.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        Bytes bytes(data, size);
        const TraceInfo info = read_contents(bytes, "trace");
        Particles particles = info.scene.start;
        read_particles(bytes, "trace", 1, particles);
        static_cast<void>(frame_params(info.scene, 1));
    } catch (const Error&) { // what a reader says of a bad file
    }
    return 0;
}
