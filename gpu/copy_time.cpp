#include "gpu/copy_time.hpp"

#include "gpu/check.hpp"
#include "gpu/pass_timer.hpp"

namespace lockstep {

double copy_seconds(std::size_t bytes) {
    const GlBuffer from, to;
    const GlQuery timer;
    const auto size = static_cast<GLsizeiptr>(bytes);
    gl::BindBuffer(GL_COPY_READ_BUFFER, from.id());
    gl::BufferData(GL_COPY_READ_BUFFER, size, nullptr, GL_DYNAMIC_COPY);
    gl::BindBuffer(GL_COPY_WRITE_BUFFER, to.id());
    gl::BufferData(GL_COPY_WRITE_BUFFER, size, nullptr, GL_DYNAMIC_COPY);
    const auto copy = [&] {
        gl::CopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0, 0, size);
        gl::Finish();
    };
    copy(); // memory that was never touched is slow at first
    {
        const RunningTimer timing(timer);
        copy();
    }
    check_gl("copy of a buffer");
    return seconds_of(timer);
}

} // namespace lockstep
