#include "render/image_comparison.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace grainbench::render {
namespace {

constexpr int reach = 5;                       // pixels; the window is 11 wide
constexpr double deviation = 1.5;              // pixels
constexpr double c1 = 0.0001 * 255.0 * 255.0;  // (0.01 L)^2: keeps dark windows from dividing by 0
constexpr double c2 = 0.0009 * 255.0 * 255.0;  // (0.03 L)^2: the same for flat windows

using Weights = std::array<double, 2 * reach + 1>;

Weights window_weights() {
    Weights weights{};
    double sum = 0.0;
    for (int k = -reach; k <= reach; ++k) {
        const double weight = std::exp(-0.5 * k * k / (deviation * deviation));
        weights[static_cast<std::size_t>(k + reach)] = weight;
        sum += weight;
    }
    for (double& weight : weights) {
        weight /= sum;
    }
    return weights;
}

/// Numbers at each pixel.
class Plane {
public:
    explicit Plane(ImageSize size)
        : size_(size),
          values_(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height)) {}

    ImageSize size() const { return size_; }

    double& at(int x, int y) { return values_[index(x, y)]; }

    double at(int x, int y) const { return values_[index(x, y)]; }

private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width) +
               static_cast<std::size_t>(x);
    }

    ImageSize size_;
    std::vector<double> values_;
};

/// Mean over the window; beyond the border the border goes on.
Plane window_mean(const Plane& plane) {
    static const Weights weights = window_weights();
    const auto [width, height] = plane.size();
    Plane across(plane.size());
    Plane both(plane.size());
    const auto weighted = [&](auto value_at) {
        double sum = 0.0;
        for (int k = -reach; k <= reach; ++k) {
            sum += weights[static_cast<std::size_t>(k + reach)] * value_at(k);
        }
        return sum;
    };
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            across.at(x, y) =
                weighted([&](int k) { return plane.at(std::clamp(x + k, 0, width - 1), y); });
        }
    }
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            both.at(x, y) =
                weighted([&](int k) { return across.at(x, std::clamp(y + k, 0, height - 1)); });
        }
    }
    return both;
}

/// Pixel by pixel, a function of two planes.
template <class Function>
Plane combined(const Plane& a, const Plane& b, Function function) {
    Plane result(a.size());
    for (int y = 0; y < a.size().height; ++y) {
        for (int x = 0; x < a.size().width; ++x) {
            result.at(x, y) = function(a.at(x, y), b.at(x, y));
        }
    }
    return result;
}

Plane channel(const Image& image, int colour) {
    Plane plane(image.size);
    for (int y = 0; y < image.size.height; ++y) {
        for (int x = 0; x < image.size.width; ++x) {
            const auto pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(image.size.width) +
                static_cast<std::size_t>(x);
            plane.at(x, y) = image.rgb[3 * pixel + static_cast<std::size_t>(colour)];
        }
    }
    return plane;
}

/// Adds a third of the SSIM of one colour to each pixel.
void add_similarity(const Plane& a, const Plane& b, Plane& sum) {
    const auto product = [](double u, double v) { return u * v; };
    const Plane mean_a = window_mean(a);
    const Plane mean_b = window_mean(b);
    const Plane square_a = window_mean(combined(a, a, product));
    const Plane square_b = window_mean(combined(b, b, product));
    const Plane both = window_mean(combined(a, b, product));
    for (int y = 0; y < a.size().height; ++y) {
        for (int x = 0; x < a.size().width; ++x) {
            const double ma = mean_a.at(x, y);
            const double mb = mean_b.at(x, y);
            const double variance_a = square_a.at(x, y) - ma * ma;
            const double variance_b = square_b.at(x, y) - mb * mb;
            const double covariance = both.at(x, y) - ma * mb;
            sum.at(x, y) += (2.0 * ma * mb + c1) * (2.0 * covariance + c2) /
                            ((ma * ma + mb * mb + c1) * (variance_a + variance_b + c2)) / 3.0;
        }
    }
}

/// Pale grey where the pictures agree; the redder the less alike they are.
Image picture_of(const Image& first, const Plane& similarity) {
    Image picture = blank_image(first.size, 255);
    for (int y = 0; y < first.size.height; ++y) {
        for (int x = 0; x < first.size.width; ++x) {
            const std::size_t pixel =
                3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(first.size.width) +
                     static_cast<std::size_t>(x));
            const double grey =
                (first.rgb[pixel] + first.rgb[pixel + 1] + first.rgb[pixel + 2]) / 3.0;
            const double pale = 255.0 - 0.25 * (255.0 - grey);
            const double unlike = std::clamp(1.0 - similarity.at(x, y), 0.0, 1.0);
            picture.rgb[pixel] = static_cast<std::uint8_t>(pale + unlike * (220.0 - pale));
            picture.rgb[pixel + 1] = static_cast<std::uint8_t>(pale * (1.0 - unlike));
            picture.rgb[pixel + 2] = static_cast<std::uint8_t>(pale * (1.0 - unlike));
        }
    }
    return picture;
}

std::size_t count_differing(const Image& first, const Image& second) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < first.rgb.size(); k += 3) {
        const bool is_equal = std::equal(first.rgb.begin() + static_cast<std::ptrdiff_t>(k),
                                         first.rgb.begin() + static_cast<std::ptrdiff_t>(k + 3),
                                         second.rgb.begin() + static_cast<std::ptrdiff_t>(k));
        count += is_equal ? 0 : 1;
    }
    return count;
}

}  // namespace

ImageComparison compare_images(const Image& first, const Image& second) {
    if (first.size != second.size) {
        throw_bad_input({.what = fmt::format("the pictures have {} x {} and {} x {} pixels",
                                             first.size.width,
                                             first.size.height,
                                             second.size.width,
                                             second.size.height),
                         .where = "sizes",
                         .likely_cause = "they were drawn with other looks",
                         .next_step = "draw both with the same --size"});
    }
    Plane similarity(first.size);
    for (int colour = 0; colour < 3; ++colour) {
        add_similarity(channel(first, colour), channel(second, colour), similarity);
    }
    ImageComparison comparison;
    comparison.differing_pixels = count_differing(first, second);
    double sum = 0.0;
    for (int y = 0; y < first.size.height; ++y) {
        for (int x = 0; x < first.size.width; ++x) {
            sum += similarity.at(x, y);
            if (similarity.at(x, y) < comparison.lowest) {
                comparison.lowest = similarity.at(x, y);
                comparison.lowest_x = x;
                comparison.lowest_y = y;
            }
        }
    }
    // Equal pictures differ from 1 by rounding only.
    comparison.similarity = comparison.differing_pixels == 0
                                ? 1.0
                                : sum / (static_cast<double>(first.size.width) *
                                         static_cast<double>(first.size.height));
    comparison.difference = picture_of(first, similarity);
    return comparison;
}

std::string similarity_in_words(const ImageComparison& comparison) {
    if (comparison.differing_pixels == 0) {
        return "the same, pixel by pixel";
    }
    const double similarity = comparison.similarity;
    return similarity >= 0.99   ? "the same at a glance"
           : similarity >= 0.95 ? "small differences, such as other edges or a few things moved"
           : similarity >= 0.80 ? "clear differences"
                                : "different pictures";
}

}  // namespace grainbench::render
