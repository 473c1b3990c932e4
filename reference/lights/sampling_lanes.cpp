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

/// The linear interpolations.
template <class F> class ChannelSampling {
    using Number = NumberOf<Scalar<F>>;
    using Channels = LaneReal<F>; ///< here a channel a lane

  public:
    ChannelSampling(const Host& host, const SystemView& state) : host_(host), state_(state) {}

    /// False where they are not asked for, or the samples lie too far apart.
    bool at(const glm::vec3& u, std::array<float, lane_count>& made) const {
        const Interpolation how = host_.switches().interpolation;
        if (how != Interpolation::trilinear && how != Interpolation::trilinear8)
            return false;
        const auto count = static_cast<std::size_t>(samples(host_.switches().supersample));
        const Axis x = axis(u.x, count), y = axis(u.y, count), z = axis(u.z, count);
        if (!(x.has_few(count) && y.has_few(count) && z.has_few(count)))
            return false;
        const Channels all = linear(x, y, z, count);
        std::memcpy(made.data(), &all.v, sizeof made);
        return true;
    }

  private:
    static constexpr std::size_t most_samples = 4, most_texels = 3; ///< along an axis

    struct Axis {
        std::array<int, most_samples> base{};
        std::array<float, most_samples> f{}, rest{}; ///< 1 - f
        [[nodiscard]] std::size_t before(std::size_t i) const { return static_cast<std::size_t>(base[i] - base[0]); }
        [[nodiscard]] std::size_t texels(std::size_t count) const { return before(count - 1) + 2; }
        [[nodiscard]] bool has_few(std::size_t count) const { return texels(count) <= most_texels; }
    };
    /// Texels along an axis, one beside the other.
    struct Line {
        std::array<std::size_t, most_texels> place{}; ///< times how far they are apart
        std::array<bool, most_texels> is_seen{};
    };
    [[nodiscard]] Line line(const Axis& along, std::size_t texels, int size, std::size_t apart) const {
        Line made;
        for (std::size_t k = 0; k < texels; ++k) {
            const int at = along.base[0] + static_cast<int>(k), inside = std::clamp(at, 0, size - 1);
            made.place[k] = static_cast<std::size_t>(inside) * apart;
            made.is_seen[k] = at == inside || host_.switches().outside != Outside::black;
        }
        return made;
    }

    [[nodiscard]] Axis axis(float u, std::size_t count) const {
        Axis made;
        for (std::size_t i = 0; i < count; ++i) {
            const float offset = (static_cast<float>(i) + 0.5F) / static_cast<float>(count) - 0.5F;
            const Number t = (count == 1 ? Number(u) : Number(u) + Number(offset)) - Number(0.5F);
            const int base = static_cast<int>(std::floor(static_cast<float>(t)));
            Number f = t - Number(static_cast<float>(base));
            if (host_.switches().interpolation == Interpolation::trilinear8)
                f = Number(std::floor(static_cast<float>(Number(256.0F) * f + Number(0.5F)))) * Number(1.0F / 256.0F);
            made.base[i] = base;
            made.f[i] = static_cast<float>(f);
            made.rest[i] = static_cast<float>(Number(1.0F) - f);
        }
        return made;
    }
    [[nodiscard]] Channels texel(std::size_t voxel) const {
        const std::size_t bytes = voxel * 4 * sizeof(float);
        std::array<float, 2 * 4> both{};
        std::memcpy(both.data(), state_[colour_image].columns[0] + bytes, 4 * sizeof(float));
        std::memcpy(both.data() + 4, state_[direction_image].columns[0] + bytes, 4 * sizeof(float));
        return F::flush(std::bit_cast<FloatLanes>(both));
    }
    static Channels lerp(const Channels& a, const Channels& b, const Axis& along, std::size_t i) {
        return a * Channels(along.rest[i]) + b * Channels(along.f[i]);
    }

    [[nodiscard]] Channels linear(const Axis& x, const Axis& y, const Axis& z, std::size_t count) const {
        const glm::ivec3 size = host_.grid().size;
        const std::size_t columns = x.texels(count), rows = y.texels(count), planes = z.texels(count);
        const auto width = static_cast<std::size_t>(size.x), height = static_cast<std::size_t>(size.y);
        const Line of_x = line(x, columns, size.x, 1), of_y = line(y, rows, size.y, width),
                   of_z = line(z, planes, size.z, width * height);
        std::array<Channels, most_samples * most_samples * most_texels> along_y; // i fastest, then j
        for (std::size_t plane = 0; plane < planes; ++plane) {
            std::array<Channels, most_samples * most_texels> along_x;
            for (std::size_t row = 0; row < rows; ++row) {
                std::array<Channels, most_texels> texels;
                for (std::size_t k = 0; k < columns; ++k)
                    texels[k] = of_x.is_seen[k] && of_y.is_seen[row] && of_z.is_seen[plane]
                                    ? texel(of_x.place[k] + of_y.place[row] + of_z.place[plane])
                                    : Channels(0.0F);
                for (std::size_t i = 0; i < count; ++i)
                    along_x[row * count + i] = lerp(texels[x.before(i)], texels[x.before(i) + 1], x, i);
            }
            for (std::size_t j = 0; j < count; ++j)
                for (std::size_t i = 0; i < count; ++i) {
                    const std::size_t row = y.before(j);
                    along_y[(plane * count + j) * count + i] =
                        lerp(along_x[row * count + i], along_x[(row + 1) * count + i], y, j);
                }
        }
        Channels sum;
        const std::size_t of_plane = count * count;
        for (std::size_t k = 0; k < count; ++k)
            for (std::size_t i = 0; i < of_plane; ++i) {
                const std::size_t plane = z.before(k);
                const Channels one = lerp(along_y[plane * of_plane + i], along_y[(plane + 1) * of_plane + i], z, k);
                sum = k + i == 0 ? one : sum + one;
            }
        return count == 1 ? sum : sum * Channels(1.0F / static_cast<float>(count * count * count));
    }

    const Host& host_;
    const SystemView& state_;
};

template <class A> [[gnu::noinline]] void by_twin(A arithmetic, const Host& host, const SystemView& state,
                                                  const glm::vec3& u, std::array<float, lane_count>& made) {
    using Number = NumberOf<A>;
    Values<A> one(arithmetic);
    const Sample<Values<A>> sample =
        SamplingTwin<Values<A>>(one, host, state).mean_at({Number(u.x), Number(u.y), Number(u.z)});
    for (std::size_t c = 0; c < made.size(); ++c)
        made[c] = static_cast<float>(sample[c]);
}

} // namespace

LOCKSTEP_VECTOR_CLONES void sample(const PlainLanes&, const Host& host, const SystemView& state, const glm::vec3& u,
                                   std::array<float, lane_count>& made) {
    if (!ChannelSampling<PlainLanes>(host, state).at(u, made))
        by_twin(Strict{}, host, state, u, made);
}
LOCKSTEP_VECTOR_CLONES void sample(const PortableLanes&, const Host& host, const SystemView& state, const glm::vec3& u,
                                   std::array<float, lane_count>& made) {
    if (!ChannelSampling<PortableLanes>(host, state).at(u, made))
        by_twin(Portable{}, host, state, u, made);
}

} // namespace lockstep::lights
