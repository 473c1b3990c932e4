#include "crosscheck/collision/record/trace_reader.hpp"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <string>

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "crosscheck/collision/record/trace_messages.hpp"
#include "crosscheck/collision/record/trace_process.hpp"
#include "crosscheck/record/seal.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/error.hpp"

namespace lockstep {
namespace {

constexpr int patience = 120'000; // milliseconds without a byte

/// What it means that the reading process ended of a signal; 0: of none.
std::string end_text(int signal) {
    switch (signal) {
    case SIGSEGV:
    case SIGBUS:
    case SIGABRT:
    case SIGFPE:
    case SIGILL:
    case SIGSYS:
        return fmt::format("HDF5 broke on it ({}): the file is not what its seal says, or was made to do harm",
                           strsignal(signal));
    case SIGXCPU:
        return "reading one state of it took over a minute of processor time";
    case 0:
        return "the process that reads it ended early: the file is not what its seal says, or was made to do harm";
    case SIGKILL:
        return "the process that reads it was killed from outside (Killed), as systems do where memory runs out; try "
               "again";
    default:
        return fmt::format("the process that reads it was ended from outside ({}); try again", strsignal(signal));
    }
}

} // namespace

/// The process that reads, and what it says.
class TraceReader::Process : public ByteSource {
  public:
    explicit Process(const OpenedFile& file) : file_(file.path().string()), process_(start_trace_process(file)) {}
    ~Process() override { end_trace_process(process_, std::chrono::milliseconds(0)); }

    void ask(MessageKind kind, int index) {
        const Request request{kind, static_cast<std::uint32_t>(index)};
        if (send(process_.requests, &request, sizeof request, MSG_NOSIGNAL) != sizeof request)
            broke();
    }

    void read(void* into, std::size_t bytes) override {
        char* at = static_cast<char*>(into);
        while (bytes > 0) {
            pollfd ready{process_.answers, POLLIN, 0};
            const int polled = poll(&ready, 1, patience);
            if (polled < 0 && errno == EINTR)
                continue;
            if (polled == 0)
                throw Error(fmt::format("{}: nothing could be read from it for {} s", file_, patience / 1000));
            const ssize_t got = ::read(process_.answers, at, bytes);
            if (got < 0 && errno == EINTR)
                continue;
            if (got <= 0)
                broke();
            at += got;
            bytes -= static_cast<std::size_t>(got);
        }
    }

    [[nodiscard]] const std::string& file() const { return file_; }

  private:
    [[noreturn]] void broke() {
        if (process_.pid >= 0)
            signal_ = end_trace_process(process_, std::chrono::seconds(2));
        throw Error(fmt::format("{}: {}", file_, end_text(signal_)));
    }

    std::string file_;
    TraceProcess process_;
    int signal_ = 0; ///< that it ended of
};

TraceReader::TraceReader(const std::filesystem::path& file) : file_(file, "trace") {
    check_seal(file_);
    process_ = std::make_unique<Process>(file_);
    info_ = read_contents(*process_, process_->file(), file_.size());
    file_.expect_unchanged();
}

TraceReader::~TraceReader() = default;

void TraceReader::read(int frame, Particles& particles) {
    particles.resize(info_.scene.start.size());
    process_->ask(MessageKind::particles, frame + 1);
    read_particles(*process_, process_->file(), static_cast<std::uint32_t>(frame + 1), particles);
    file_.expect_unchanged();
}

void TraceReader::read(int frame, CollisionImage& cdt) {
    cdt.width = info_.scene.width;
    cdt.height = cdt_height(info_.scene);
    cdt.texels.resize(static_cast<std::size_t>(cdt.width) * static_cast<std::size_t>(cdt.height));
    process_->ask(MessageKind::cdt, frame);
    read_cdt(*process_, process_->file(), static_cast<std::uint32_t>(frame), cdt);
    file_.expect_unchanged();
}

} // namespace lockstep
