#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <ios>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "reference/fluid/linear_laws.hpp"
#include "reference/fluid/pixel_places.hpp"
#include "reference/model/random.hpp"

namespace lockstep::test::linear_laws_test {

using namespace lockstep::fluid;

namespace {

/// Random texels, of which some are alike.
struct RandomImage {
    int width, height;
    std::vector<float> values = {};

    RandomImage(int w, int h, Random& random) : width(w), height(h) {
        for (int i = 0; i < w * h; ++i)
            values.push_back(random.unit() < 0.2 ? 1.0F : static_cast<float>(0.5 + 0.5 * random.unit()));
    }
    [[nodiscard]] auto texels() const {
        const auto texel = [this](int x, int y) { return values[static_cast<std::size_t>(y * width + x)]; };
        return Texels<decltype(texel)>{width, height, texel};
    }
};

/// Coordinates around one of the image, or of a pixel's middle, in one float or in several.
FetchedAxis random_axis(int size, Random& random) {
    const auto texels = static_cast<float>((size + 2) * random.unit() - 1.0);
    const float middle = random.unit() < 0.5 ? std::floor(texels) + 0.5F : texels;
    const auto width = random.unit() < 0.3 ? 0.0F : static_cast<float>(std::exp2(-24.0 + 16.0 * random.unit()));
    const float low = middle / static_cast<float>(size);
    return {{low, low + width}, size};
}
FetchedAxis point_of(const FetchedAxis& axis, Random& random) {
    const double share = random.unit();
    const auto at = static_cast<float>(axis.set.low + share * (axis.set.high - axis.set.low));
    return {Interval(std::clamp(at, axis.set.as_float(), static_cast<float>(axis.set.high))), axis.size};
}

} // namespace

TEST_CASE("linear laws: a set of coordinates holds what each of its floats gives") {
    Random random(17, 0);
    std::size_t narrow = 0, all = 0;
    for (int turn = 0; turn < 20000; ++turn) {
        const RandomImage image(2 + static_cast<int>(random.unit() * 40), 2 + static_cast<int>(random.unit() * 40),
                                random);
        const FetchedAxis x = random_axis(image.width, random), y = random_axis(image.height, random);
        const Interval by_bits = legal_fetch(LinearFilter::all_bits, x, y, image.texels()),
                       aligned = legal_fetch(LinearFilter::aligned, x, y, image.texels()),
                       open = legal_fetch(LinearFilter::open, x, y, image.texels());
        for (int i = 0; i < 4; ++i) {
            const FetchedAxis u = point_of(x, random), v = point_of(y, random);
            const float fused = linear_laws::mixed(u, v, image.texels(), linear_laws::fused),
                        lerped = linear_laws::mixed(u, v, image.texels(), linear_laws::lerped),
                        in_256ths = fetched(LinearFilter::aligned, u, v, image.texels());
            INFO("turn " << turn << ", " << u.set.low << ", " << v.set.low);
            CHECK(by_bits.contains(fused));
            CHECK(by_bits.contains(lerped));
            CHECK(aligned.contains(in_256ths));
            CHECK(open.contains(fused));
            CHECK(open.contains(in_256ths));
        }
        narrow += by_bits.high - by_bits.low <= open.high - open.low ? 1U : 0U;
        ++all;
    }
    CHECK(narrow == all);
}

TEST_CASE("linear laws: a unit of fixed point gives what one was measured to give") {
    std::ifstream file("data/results/h200/plane_filter.txt");
    std::string line;
    while (std::getline(file, line) && line.starts_with("#")) {
    }
    const auto next = [](std::istringstream& words) {
        std::uint32_t bits = 0;
        words >> std::hex >> bits;
        return std::bit_cast<float>(bits);
    };
    std::istringstream head(line);
    int width = 0, height = 0;
    head >> width >> height;
    std::vector<float> values;
    for (int i = 0; i < width * height; ++i)
        values.push_back(next(head));
    const auto texel = [&](int x, int y) { return values[static_cast<std::size_t>(y * width + x)]; };
    const Texels<decltype(texel)> image{width, height, texel};
    std::size_t measured = 0, right = 0, legal = 0;
    while (std::getline(file, line)) {
        std::istringstream words(line);
        const FetchedAxis x{Interval(next(words)), width}, y{Interval(next(words)), height};
        const float value = next(words);
        ++measured;
        right += fetched(LinearFilter::aligned, x, y, image) == value ? 1U : 0U;
        legal += legal_fetch(LinearFilter::open, x, y, image).contains(value) ? 1U : 0U;
    }
    CHECK(measured == 634);
    CHECK(right == measured);
    CHECK(legal == measured);
}

TEST_CASE("linear laws: texels that are alike stay as they are, where the driver is followed") {
    const auto one = [](int, int) { return 1.0F; };
    const Texels<decltype(one)> image{800, 800, one};
    const FetchedAxis x{{0.3, 0.3001}, 800}, y{{0.7, 0.7}, 800};
    for (const LinearFilter filter : {LinearFilter::all_bits, LinearFilter::aligned}) {
        const Interval set = legal_fetch(filter, x, y, image);
        CHECK(set.is_point());
        CHECK(set.contains(1.0F));
    }
}

TEST_CASE("linear laws: a unit of fixed point gives pixels their own texels up to some thousand pixels") {
    for (const int size : {1, 33, 160, 799, 800, 1920, 3840})
        CHECK(middles_are_texels(size));
    CHECK_FALSE(middles_are_texels(16383));
}

TEST_CASE("linear laws: a coordinate that is no number may give any of the image, one beyond it gives its edge") {
    const auto column = [](int x, int) { return static_cast<float>(x); };
    const Texels<decltype(column)> image{8, 1, column};
    const FetchedAxis nowhere{Interval(NAN), 8}, middle{Interval(0.5F), 1};
    for (const LinearFilter filter : {LinearFilter::all_bits, LinearFilter::aligned, LinearFilter::open}) {
        const Interval any = legal_fetch(filter, nowhere, middle, image),
                       behind = legal_fetch(filter, {Interval(7.0F), 8}, middle, image);
        CHECK((any.low <= 0.0 && any.high >= 7.0));
        CHECK(behind.contains(7.0F));
        CHECK(behind.high - behind.low < 1e-3);
    }
}

} // namespace lockstep::test::linear_laws_test
