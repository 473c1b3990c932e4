#pragma once
#include "reference/lifecycle/particle.hpp"

/// What an emitter counts. Twin of shaders/lifecycle/lifecycle.glsl.
namespace lockstep::lifecycle {

constexpr std::uint32_t groups_of(std::uint32_t n) { return (n + 255U) >> 8U; }
constexpr std::uint32_t blocks_of(std::uint32_t n) { return (n + 1023U) >> 10U; }

template <class R> std::uint32_t noted(R& r, At place, std::uint32_t value) {
    return static_cast<std::uint32_t>(static_cast<int>(r.note(place, typename R::Int(static_cast<int>(value)))));
}

/// An item of uints that a pass changes.
template <class R> class UintItem {
  public:
    UintItem(R& reading, const SystemView& state, std::uint8_t resource, std::size_t item)
        : r(reading), raw_(raw_words(state, resource, item)), words_(0) {
        for (const Field& field : state[resource].fields())
            words_ += static_cast<std::size_t>(field.components);
    }
    [[nodiscard]] std::uint32_t operator[](std::size_t word) const { return raw_[word]; }
    void set(At place, std::size_t word, std::uint32_t value) { raw_[word] = noted(r, place, value); }
    void set_groups(At place, std::size_t argument, std::uint32_t count) {
        set(place, 3 * argument, count);
        raw_[3 * argument + 1] = raw_[3 * argument + 2] = 1;
    }
    [[nodiscard]] ItemWords<R> record() const {
        ItemWords<R> all;
        for (std::size_t w = 0; w < words_; ++w)
            all.add(raw_[w]);
        return all;
    }

  private:
    R& r;
    RawWords raw_;
    std::size_t words_;
};

/// One word of an emitter's counters.
template <class R>
std::uint32_t count_before(R& r, At place, const PassInput& in, const HostEmitter& of, std::uint8_t word) {
    return noted(r, place, in.before.word({counter_buffer, word}, of.number));
}

/// What a pass knows of the emitter it works for.
template <class R> class EmitterTwin {
  public:
    EmitterTwin(R& reading, const Host& host, const HostEmitter& of, const PassInput& in)
        : r(reading), host_(host), of_(of), in_(in) {}

    [[nodiscard]] std::uint32_t alive() const { return count_before(r, site::alive_before, in_, of_, counter::alive); }
    [[nodiscard]] std::uint32_t may_die() const {
        return count_before(r, site::may_die_before, in_, of_, counter::may_die);
    }
    [[nodiscard]] std::uint32_t emitted() const { return count_before(r, site::emitted, in_, of_, counter::emitted); }
    [[nodiscard]] std::uint32_t survivors() const {
        return count_before(r, site::survivors_before, in_, of_,
                            host_.switches().compaction == Compaction::scan ? counter::survivors : counter::append);
    }
    /// At the start of the destroy pass.
    [[nodiscard]] std::uint32_t present() const {
        return noted(r, site::particles_present,
                     host_.switches().emit_when == EmitWhen::before_destroy ? alive() + emitted() : alive());
    }
    [[nodiscard]] std::uint32_t capacity() const {
        return noted(r, site::capacity, static_cast<std::uint32_t>(of_.settings().capacity));
    }
    /// Whether an item lies in the emitter's segment; `slot` is its place there.
    [[nodiscard]] bool has(std::size_t item) const { return item >= of_.base && item - of_.base < of_.slots; }
    [[nodiscard]] std::uint32_t slot(std::size_t item) const { return static_cast<std::uint32_t>(item - of_.base); }
    /// Whether an item of the survivors may be one that is listed now; `list_place` is its place there.
    [[nodiscard]] bool may_list(std::size_t item) const {
        return item >= next_list() && item - next_list() < of_.slots;
    }
    [[nodiscard]] std::uint32_t list_place(std::size_t item) const {
        return static_cast<std::uint32_t>(item - next_list());
    }
    [[nodiscard]] RawWords words_of(std::uint32_t slot) const {
        return raw_words(in_.before, particle_buffer, of_.base + slot);
    }
    // Of index lists: where the list of the living begins, and that which is being made.
    [[nodiscard]] std::size_t living_list() const { return 2 * of_.base + list() * of_.slots; }
    [[nodiscard]] std::size_t next_list() const {
        return host_.lists() ? 2 * of_.base + (1U - list()) * of_.slots : of_.base;
    }
    /// Of the particle that is `place`-th.
    [[nodiscard]] std::uint32_t slot_at(std::uint32_t place) const {
        if (!host_.lists())
            return place;
        return noted(r, site::listed, in_.before.word({survivor_buffer, 0}, living_list() + place));
    }
    /// Of the point of a ribbon that is `place`-th.
    [[nodiscard]] std::uint32_t point_slot(std::uint32_t place) const {
        return host_.lists() ? in_.before.word({key_buffer, 2}, of_.first_key + place) : place;
    }
    /// Of those that may die.
    [[nodiscard]] bool survives(std::uint32_t place) const {
        const std::uint32_t n = present(), most = capacity();
        if (n > most && r.decide(site::overflows, place < n - most))
            return false;
        return r.decide(site::survives, Particle<R>(r, host_, words_of(slot_at(place))).remaining() > 0.0F);
    }
    /// The slot of the `rank`-th survivor of `d` that may die, `seen` of which come before `place`.
    [[nodiscard]] std::optional<std::uint32_t> survivor(std::uint32_t rank, std::uint32_t d, std::uint32_t place = 0,
                                                        std::uint32_t seen = 0) const {
        for (; place < d; ++place)
            if (survives(place) && seen++ == rank)
                return slot_at(place);
        return {};
    }
    [[nodiscard]] std::uint32_t destroy_groups(std::uint32_t d) const {
        return host_.switches().compaction == Compaction::scan ? blocks_of(d) : groups_of(d);
    }

  private:
    [[nodiscard]] std::uint32_t list() const {
        return in_.before.word({counter_buffer, counter::list}, of_.number) & 1U;
    }

    R& r;
    const Host& host_;
    const HostEmitter& of_;
    const PassInput& in_;
};

} // namespace lockstep::lifecycle
