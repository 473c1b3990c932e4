#include "reference/lights/sampling_lanes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "reference/vector_loops.hpp"

namespace lockstep::lights {
namespace {

template <class F> using Scalar = std::conditional_t<std::is_same_v<F, PortableLanes>, Portable, Strict>;

/// The linear interpolations, of `count` samples along each axis.
template <class F, std::size_t count> class ChannelSampling {
    using Real = LaneReal<F>;
    using Channels = FloatLanes; ///< a channel a lane

  public:
    ChannelSampling(const Host& host, const SystemView& state, const LanePlaces& places)
        : host_(host), state_(state), axes_{axis(places[0]), axis(places[1]), axis(places[2])} {}

    /// Of one lane. False where its samples lie too far apart.
    LOCKSTEP_INLINE bool at(int lane, Channels& made) const {
        const glm::ivec3 size = host_.grid().size;
        const auto width = static_cast<std::size_t>(size.x), height = static_cast<std::size_t>(size.y);
        const Line x = line(axes_[0], lane, size.x, 1), y = line(axes_[1], lane, size.y, width),
                   z = line(axes_[2], lane, size.z, width * height);
        if (x.texels > most_texels || y.texels > most_texels || z.texels > most_texels)
            return false;
        made = linear(x, y, z);
        return true;
    }

  private:
    static constexpr std::size_t most_texels = count == 1 ? 2 : 3; ///< along an axis

    struct Axis {
        std::array<IntLanes, count> base;
        std::array<FloatLanes, count> f, rest; ///< 1 - f
    };
    [[nodiscard]] LOCKSTEP_INLINE Axis axis(const FloatLanes& u) const {
        Axis made;
        for (std::size_t i = 0; i < count; ++i) {
            const float offset = (static_cast<float>(i) + 0.5F) / static_cast<float>(count) - 0.5F;
            const Real t = (count == 1 ? Real(u) : Real(u) + Real(offset)) - Real(0.5F);
            made.base[i] = __builtin_convertvector(lanes::floor(t.v), IntLanes);
            Real f = t - Real(__builtin_convertvector(made.base[i], FloatLanes));
            if (host_.switches().interpolation == Interpolation::trilinear8)
                f = Real(lanes::floor((Real(256.0F) * f + Real(0.5F)).v)) * Real(1.0F / 256.0F);
            made.f[i] = f.v;
            made.rest[i] = (Real(1.0F) - f).v;
        }
        return made;
    }

    /// Texels along an axis, one beside the other, and where the samples lie among them.
    struct Line {
        std::size_t texels;
        std::array<std::size_t, count> before;
        std::array<Channels, count> f, rest;
        std::array<std::size_t, most_texels> place; ///< times how far they are apart
        std::array<bool, most_texels> is_seen;
    };
    [[nodiscard]] LOCKSTEP_INLINE Line line(const Axis& along, int lane, int size, std::size_t apart) const {
        Line made;
        const int base = along.base[0][lane];
        for (std::size_t i = 0; i < count; ++i) {
            made.before[i] = static_cast<std::size_t>(along.base[i][lane] - base);
            made.f[i] = lanes::all(along.f[i][lane]);
            made.rest[i] = lanes::all(along.rest[i][lane]);
        }
        made.texels = made.before[count - 1] + 2;
        for (std::size_t k = 0; k < most_texels; ++k) {
            const int at = base + static_cast<int>(k), inside = std::clamp(at, 0, size - 1);
            made.place[k] = static_cast<std::size_t>(inside) * apart;
            made.is_seen[k] = at == inside || host_.switches().outside != Outside::black;
        }
        return made;
    }

    [[nodiscard]] LOCKSTEP_INLINE Channels texel(std::size_t voxel) const {
        const std::size_t bytes = voxel * 4 * sizeof(float);
        std::array<float, 2 * 4> both;
        std::memcpy(both.data(), state_[colour_image].columns[0] + bytes, 4 * sizeof(float));
        std::memcpy(both.data() + 4, state_[direction_image].columns[0] + bytes, 4 * sizeof(float));
        return F::flush(std::bit_cast<FloatLanes>(both));
    }
    LOCKSTEP_INLINE static Channels lerp(const Channels& a, const Channels& b, const Line& along, std::size_t i) {
        return F::flush(F::flush(a * along.rest[i]) + F::flush(b * along.f[i]));
    }

    [[nodiscard]] LOCKSTEP_INLINE Channels linear(const Line& x, const Line& y, const Line& z) const {
        std::array<Channels, count * count * most_texels> along_y; // i fastest, then j
        for (std::size_t plane = 0; plane < z.texels; ++plane) {
            std::array<Channels, count * most_texels> along_x;
            for (std::size_t row = 0; row < y.texels; ++row) {
                std::array<Channels, most_texels> texels;
                for (std::size_t k = 0; k < x.texels; ++k)
                    texels[k] = x.is_seen[k] && y.is_seen[row] && z.is_seen[plane]
                                    ? texel(x.place[k] + y.place[row] + z.place[plane])
                                    : lanes::all(0.0F);
                for (std::size_t i = 0; i < count; ++i)
                    along_x[row * count + i] = lerp(texels[x.before[i]], texels[x.before[i] + 1], x, i);
            }
            for (std::size_t j = 0; j < count; ++j)
                for (std::size_t i = 0; i < count; ++i) {
                    const std::size_t row = y.before[j];
                    along_y[(plane * count + j) * count + i] =
                        lerp(along_x[row * count + i], along_x[(row + 1) * count + i], y, j);
                }
        }
        constexpr std::size_t of_plane = count * count;
        Channels sum;
        for (std::size_t k = 0; k < count; ++k)
            for (std::size_t i = 0; i < of_plane; ++i) {
                const std::size_t plane = z.before[k];
                const Channels one = lerp(along_y[plane * of_plane + i], along_y[(plane + 1) * of_plane + i], z, k);
                sum = k + i == 0 ? one : F::flush(sum + one);
            }
        return count == 1 ? sum : F::flush(sum * (1.0F / static_cast<float>(count * of_plane)));
    }

    const Host& host_;
    const SystemView& state_;
    std::array<Axis, 3> axes_;
};

template <class A> [[gnu::noinline]] void by_twin(A arithmetic, const Host& host, const SystemView& state,
                                                  const LanePlaces& places, int lane, FloatLanes& made) {
    using Number = NumberOf<A>;
    Values<A> one(arithmetic);
    const auto along = [&](std::size_t axis) { return Number(places[axis][lane]); };
    const Sample<Values<A>> sample = SamplingTwin<Values<A>>(one, host, state).mean_at({along(0), along(1), along(2)});
    for (std::size_t c = 0; c < sample.size(); ++c)
        made[static_cast<int>(c)] = static_cast<float>(sample[c]);
}

template <class F, std::size_t count> LOCKSTEP_INLINE void
samples_of(const Host& host, const SystemView& state, const LanePlaces& places, unsigned active, LaneSamples& made) {
    const ChannelSampling<F, count> linear(host, state, places);
    const Interpolation how = host.switches().interpolation;
    const bool is_linear = how == Interpolation::trilinear || how == Interpolation::trilinear8;
    for (int lane = 0; lane < lane_count; ++lane)
        if (FloatLanes& one = made[static_cast<std::size_t>(lane)];
            (active >> lane & 1U) != 0 && !(is_linear && linear.at(lane, one)))
            by_twin(Scalar<F>{}, host, state, places, lane, one);
}

template <class F> LOCKSTEP_INLINE void samples_at(const Host& host, const SystemView& state, const LanePlaces& places,
                                                   unsigned active, LaneSamples& made) {
    switch (host.switches().supersample) {
    case Supersample::one:
        return samples_of<F, 1>(host, state, places, active, made);
    case Supersample::two:
        return samples_of<F, 2>(host, state, places, active, made);
    case Supersample::four:
        return samples_of<F, 4>(host, state, places, active, made);
    }
}

} // namespace

LOCKSTEP_VECTOR_CLONES void sample(const PlainLanes&, const Host& host, const SystemView& state,
                                   const LanePlaces& places, unsigned active, LaneSamples& made) {
    samples_at<PlainLanes>(host, state, places, active, made);
}
LOCKSTEP_VECTOR_CLONES void sample(const PortableLanes&, const Host& host, const SystemView& state,
                                   const LanePlaces& places, unsigned active, LaneSamples& made) {
    samples_at<PortableLanes>(host, state, places, active, made);
}

} // namespace lockstep::lights
