#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "crosscheck/files/opened_file.hpp"
#include "crosscheck/record/messages.hpp"

namespace lockstep {

/// The reading process's side of a ReadingProcess.
class ReadingEnd {
  public:
    /// `memory`: bytes of address space that it has so far. `unfenced`: why the kernel gave no fence; empty: it did.
    ReadingEnd(std::size_t memory, std::string unfenced) : memory_(memory), unfenced_(std::move(unfenced)) {}

    /// Once the file is open: it can open no other from here on.
    void put_up_fence();
    /// Before states are read: what they take, in bytes, besides what opening took. Adds to `warnings` where there is
    /// no fence.
    void allow(std::size_t bytes, std::vector<std::string>& warnings) const;

    static void send(const MessageHead& head, const void* bytes);
    static void send(MessageKind kind, const std::string& text) { send({kind, 0, text.size()}, text.data()); }
    template <class Value> static void send(MessageKind kind, const std::vector<Value>& values) {
        send({kind, 0, values.size() * sizeof(Value)}, values.data());
    }
    /// Waits for what is wanted next; false: nothing more.
    static bool next(Request& request);

  private:
    std::size_t memory_;
    std::string unfenced_;
};

/// The process that reads a recording: all that libhdf5 does with a file's bytes happens in it. It has that one file
/// open and can open no other, write none, start no process, and use so much memory and time (syscall_fence.hpp,
/// setrlimit); what it makes of the file it tells through a pipe (messages.hpp). Where it breaks, the asking process
/// gets an Error.
class ReadingProcess final : public ByteSource {
  public:
    /// Forks; `work` runs there, and what it throws is told as an error. Throws Error where the system refuses.
    ReadingProcess(const OpenedFile& file, const std::function<void(ReadingEnd&)>& work);
    ~ReadingProcess() override;

    void ask(MessageKind kind, int index, std::uint32_t resource = 0);
    void read(void* into, std::size_t bytes) override;
    [[nodiscard]] const std::string& file() const { return file_; }

    struct Started {
        int pid = -1;
        int requests = -1; ///< socket: Request after Request; closing it ends the process
        int answers = -1;  ///< pipe: the contents, then one message a request
    };

  private:
    [[noreturn]] void broke();

    std::string file_;
    Started process_;
    int signal_ = 0; ///< that it ended of
};

} // namespace lockstep
