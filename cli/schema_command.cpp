#include "cli/schema_command.hpp"

#include "io/json/schema.hpp"
#include "io/study.hpp"

#include "render/look_json.hpp"

#include "cli/exit_codes.hpp"
#include "cli/figures/figure_set.hpp"

#include <array>
#include <string_view>

namespace grainbench::cli {
namespace {

struct Kind {
    std::string_view name;
    std::string (*schema)();
    std::string (*reference)();
};

constexpr std::array kinds{Kind{"scene", io::scene_schema, io::scene_reference},
                           Kind{"figures", figure_set_schema, figure_set_reference},
                           Kind{"render", render::look_schema, render::look_reference},
                           Kind{"study", io::study_schema, io::study_reference}};

}  // namespace

std::vector<std::string> schema_kinds() {
    std::vector<std::string> names;
    names.reserve(kinds.size());
    for (const Kind& kind : kinds) {
        names.emplace_back(kind.name);
    }
    return names;
}

int schema_command(const SchemaArguments& arguments, const Streams& streams) {
    for (const Kind& kind : kinds) {
        if (kind.name == arguments.kind) {
            streams.out << (arguments.markdown ? kind.reference() : kind.schema());
        }
    }
    return exit_ok;
}

}  // namespace grainbench::cli
