#include "cli/schema_command.hpp"

#include "io/json/schema.hpp"

#include "cli/exit_codes.hpp"

namespace grainbench::cli {

int schema_command(const SchemaArguments& arguments, const Streams& streams) {
    streams.out << (arguments.markdown ? io::scene_reference() : io::scene_schema());
    return exit_ok;
}

}  // namespace grainbench::cli
