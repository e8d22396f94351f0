/// Charts as files. What they look like was looked at; here is what can be counted.
#include "render/chart.hpp"

#include "io/atomic_file.hpp"

#include "render/image.hpp"

#include "tests/unit/io/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>

namespace grainbench::render {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// One of each kind of series, with notes, on a small page.
Chart every_kind() {
    Chart chart;
    chart.title = "All kinds";
    chart.x = {.label = "time", .unit = "s"};
    chart.y = {.label = "height < 1 & \"more\"", .unit = "cm"};
    chart.width = 480;
    chart.height = 300;
    for (const SeriesKind kind : {SeriesKind::line, SeriesKind::band, SeriesKind::points}) {
        ChartSeries series{.name = "series " + std::to_string(chart.series.size()), .kind = kind};
        for (int k = 0; k <= 20; ++k) {
            const double y = std::sin(0.3 * k + static_cast<double>(chart.series.size()));
            series.x.push_back(k);
            series.y.push_back(y);
            series.low.push_back(y - 0.1);
            series.high.push_back(y + 0.1);
        }
        if (kind == SeriesKind::line) {
            series.low.clear();
            series.high.clear();
            series.y[10] = std::numeric_limits<double>::quiet_NaN();
        }
        chart.series.push_back(series);
    }
    chart.vertical_lines = {{.x = 5.0, .text = "switch"}};
    chart.texts = {{.x = 1.0, .y = 0.0, .text = "note"}};
    return chart;
}

Chart two_bars() {
    Chart chart;
    chart.x = {.label = "scheme"};
    chart.y = {.label = "time", .unit = "s"};
    chart.width = 480;
    chart.height = 300;
    chart.categories = {"fixed, small", "automatic"};
    chart.series = {{.name = "run", .kind = SeriesKind::bars, .y = {2.0, 1.0}}};
    return chart;
}

TEST(Chart, GivesTheSameBytesAgain) {
    const TemporaryFolder folder;
    write_chart(every_kind(), folder / "a", {{"Seed", "7"}});
    write_chart(every_kind(), folder / "b", {{"Seed", "7"}});
    for (const char* extension : {".png", ".svg", ".csv"}) {
        EXPECT_EQ(io::read_file(folder / (std::string("a") + extension)),
                  io::read_file(folder / (std::string("b") + extension)))
            << extension;
    }
    EXPECT_EQ(folder.count(), 6U);
}

TEST(Chart, SaysWhereItComesFrom) {
    const TemporaryFolder folder;
    write_chart(two_bars(), folder / "a", {{"Seed", "7"}, {"Scene", "<bed> & wall"}});
    const vtkNew<vtkPNGReader> reader;
    reader->SetFileName((folder / "a.png").c_str());
    reader->Update();
    ASSERT_EQ(reader->GetNumberOfTextChunks(), 2U);
    EXPECT_STREQ(reader->GetTextKey(0), "Scene");
    EXPECT_STREQ(reader->GetTextValue(0), "<bed> & wall");
    EXPECT_THAT(io::read_file(folder / "a.svg"), HasSubstr("&lt;bed&gt; &amp; wall"));
}

/// The exporter of VTK 9.1 draws its own plots outside of the page (render/chart_plot.hpp).
TEST(Chart, KeepsEveryLineOfTheSvgOnThePage) {
    const TemporaryFolder folder;
    const Chart chart = every_kind();
    write_chart(chart, folder / "a", {});
    const std::string svg = io::read_file(folder / "a.svg");
    const std::regex polyline("<polyline[^>]*stroke=\"#0072b2\"[^>]*points=\"([^\"]*)\"");
    std::smatch found;
    ASSERT_TRUE(std::regex_search(svg, found, polyline));
    const std::string points = found[1];
    const std::regex pair("([-0-9.e+]+),([-0-9.e+]+)");
    int count = 0;
    for (auto it = std::sregex_iterator(points.begin(), points.end(), pair);
         it != std::sregex_iterator();
         ++it, ++count) {
        EXPECT_GT(std::stod((*it)[1]), 0.0);
        EXPECT_LT(std::stod((*it)[1]), chart.width);
        EXPECT_GT(std::stod((*it)[2]), 0.0);
        EXPECT_LT(std::stod((*it)[2]), chart.height);
    }
    EXPECT_EQ(count, 10);  // up to the gap
}

TEST(Chart, ClipsTheSvgAtItsAxes) {
    const TemporaryFolder folder;
    write_chart(every_kind(), folder / "a", {});
    const std::string svg = io::read_file(folder / "a.svg");
    std::smatch clip;
    ASSERT_TRUE(std::regex_search(
        svg, clip, std::regex("<clipPath id=\"vtkClipRect1\"><rect x=\"(\\d+)\" y=\"(\\d+)\"")));
    EXPECT_THAT(svg, HasSubstr("clip-path=\"url(#vtkClipRect1)\""));
    EXPECT_THAT(svg, Not(HasSubstr("vtkClipRect2")));
    // A grid line that is upright ends where the clip does.
    const std::regex upright(
        "stroke=\"#e1e1e1\"[^>]*points=\"\\s*([\\d.]+),([\\d.]+)\\s+\\1,([\\d.]+)");
    std::smatch grid;
    ASSERT_TRUE(std::regex_search(svg, grid, upright));
    const double top = std::min(std::stod(grid[2]), std::stod(grid[3]));
    EXPECT_NEAR(std::stod(clip[2]), top, 1.5);  // both are rounded to pixels
}

TEST(Chart, WritesTheNumbersThatItDraws) {
    EXPECT_EQ(chart_csv(two_bars()),
              "series,scheme,time [s],low,high\n"
              "run,\"fixed, small\",2,,\n"
              "run,automatic,1,,\n");
    EXPECT_THAT(chart_csv(every_kind()), StartsWith("series,time [s],"));
}

TEST(Chart, DrawsALegendThatCoversNoData) {
    // A line along the whole upper edge and one along the right one leave one corner.
    const TemporaryFolder folder;
    Chart chart = every_kind();
    chart.series = {{.name = "edge", .x = {0.0, 1.0, 1.0}, .y = {1.0, 1.0, 0.0}},
                    {.name = "same", .x = {0.0, 1.0}, .y = {1.0, 1.0}}};
    chart.vertical_lines.clear();
    chart.texts.clear();
    chart.width = 960;
    chart.height = 600;
    write_chart(chart, folder / "a", {});
    const Image image = read_png(folder / "a.png");
    // The sample line of the legend is the only blue in the lower left quarter.
    int blue = 0;
    for (int y = 320; y < 580; ++y) {
        for (int x = 40; x < 480; ++x) {
            const auto at = 3 * static_cast<std::size_t>(y * chart.width + x);
            blue += image.rgb[at] < 60 && image.rgb[at + 2] > 140 ? 1 : 0;
        }
    }
    EXPECT_GT(blue, 50);
}

TEST(Chart, CentresItsTitlesWithoutALegend) {
    const TemporaryFolder folder;
    Chart chart = two_bars();
    chart.x.label = "WWWW";
    write_chart(chart, folder / "a", {});
    const Image image = read_png(folder / "a.png");
    std::vector<int> dark;  // columns, in the rows of the title of the axis
    for (int y = chart.height - 15; y < chart.height - 4; ++y) {
        for (int x = 0; x < chart.width; ++x) {
            const auto at = 3 * static_cast<std::size_t>(y * chart.width + x);
            if (image.rgb[at] < 128) {
                dark.push_back(x);
            }
        }
    }
    ASSERT_FALSE(dark.empty());
    const auto [left, right] = std::minmax_element(dark.begin(), dark.end());
    EXPECT_NEAR(0.5 * (*left + *right), 0.5 * chart.width, 0.1 * chart.width);
    EXPECT_LT(*right - *left, 0.3 * chart.width);
}

TEST(Chart, RefusesColumnsThatDifferInLength) {
    Chart chart = every_kind();
    chart.series[1].low.pop_back();
    EXPECT_THAT(error_of([&] { write_chart(chart, "unused", {}); }),
                HasSubstr("20 lower and 21 upper ends for 21 points"));
    chart.series[0].x.pop_back();
    EXPECT_THAT(error_of([&] { write_chart(chart, "unused", {}); }),
                HasSubstr("'series 0': 20 numbers along x and 21 along y"));
    chart = two_bars();
    chart.categories.pop_back();
    EXPECT_THAT(error_of([&] { write_chart(chart, "unused", {}); }),
                HasSubstr("2 bars for 1 categories"));
}

}  // namespace
}  // namespace grainbench::render
