#pragma once
#include <array>
#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "reference/text/findings.hpp"

namespace lockstep::text {

/// Finds what two invocations of a dispatch touch without an order between them, one of them writing (GL 4.6, 7.13.1).
/// Two atomic operations are no race. What makes an order: in a group a barrier; of buffers and images a memory
/// barrier, too, of the invocation that touched first; elsewhere a memory barrier and an atomic operation after it,
/// whose word the later invocation changes by another before it goes on.
class Races {
  public:
    enum class How : std::uint8_t { read, write, atomic };
    enum class Space : std::uint8_t { shared, buffer, image };

    /// `invocations`: of a group; 0: there are no groups, and no order.
    explicit Races(Findings& findings, std::uint32_t invocations = 0)
        : findings_(findings), fences_(invocations), published_(invocations) {}

    void start_group(std::uint32_t number);
    /// SPIR-V's memory semantics (SPIR-V 3.25) of a barrier that all of the group came to, or of an invocation's memory
    /// barrier.
    void barrier(std::uint32_t semantics);
    void fence(std::uint32_t semantics, std::uint32_t invocation);
    /// `name`, `number`: of the buffer or image; `word`: of it, or of its texels; `is_coherent`: by its declaration.
    void touch(Space space, std::uint32_t number, std::uint32_t word, How how, Place place, std::string_view name,
               bool is_coherent = true);
    /// Whether a group has read or changed what another handed on to it by an atomic operation.
    [[nodiscard]] bool has_handed_on() const { return has_handed_on_; }

  private:
    static constexpr std::uint32_t nobody = 0xffffffffU;
    using BySpace = std::array<std::uint32_t, 3>;
    struct Touch {
        Place place;
        std::uint32_t by = nobody; ///< an invocation, or a group
        /// How many memory barriers the invocation had had, and how many times all of the group's was ordered.
        std::uint32_t fences = 0, epoch = 0;
        bool is_coherent = true;
    };
    /// As many as decide whether a later one races: two different ones may both be no race with it alone.
    struct Touches {
        std::array<Touch, 2> reads, atomics;
        Touch write;
        std::uint32_t group = nobody;
    };
    struct Word {
        Touches in_group, in_dispatch;
    };
    /// What an atomic operation lets others know of: what came before this many memory barriers, or orders of a group.
    struct Release {
        BySpace counts{};
        std::uint64_t when = 0;
    };
    struct Released {
        std::unordered_map<std::uint32_t, Release> by_invocation, by_group;
    };
    struct Acquired {
        const Released* from = nullptr;
        std::uint64_t when = 0;
        std::uint32_t invocation = 0, barriers = 0;
    };
    [[nodiscard]] bool has_groups() const { return !fences_.empty(); }
    [[nodiscard]] std::size_t local(std::uint32_t invocation) const { return invocation % fences_.size(); }
    [[nodiscard]] bool is_ordered(const Touch& before, std::size_t space, bool in_group,
                                  std::uint32_t invocation) const;
    [[nodiscard]] bool is_released(const Touch& before, std::size_t space, std::uint32_t invocation) const;
    void note(std::array<Touch, 2>& slots, const Touch& touch, std::size_t space, bool in_group) const;
    /// `in`: of the group, or of the dispatch. Reports a race with what is there, and adds the touch.
    void add(Touches& in, Space space, How how, const Touch& touch, std::string_view name, bool in_group);
    /// Reports that what another group handed on need not be seen, where `before` or `touch` is not coherent.
    void check_coherence(const Touch& before, How how, const Touch& touch, std::string_view name);
    void synchronize(std::uint64_t word, std::uint32_t invocation);
    void found(const Touch& before, Space space, How how, Place place, std::string_view name, bool in_group);

    Findings& findings_;
    std::unordered_map<std::uint64_t, Word> words_;
    std::uint32_t group_ = 0, barriers_ = 0;
    BySpace epochs_{};                ///< how many times all before was ordered
    std::array<bool, 3> is_fenced_{}; ///< since the last barrier
    bool has_fences_ = false;         ///< the group that runs
    bool has_handed_on_ = false;
    std::vector<BySpace> fences_, published_; ///< of each invocation of the group: so far, and at the last barrier
    std::unordered_map<std::uint64_t, Released> released_; ///< by word
    std::vector<Acquired> acquired_;                       ///< by the group
    std::uint64_t now_ = 0;
};

} // namespace lockstep::text
