// Uses the component render of the installed package: draws a test picture.
#include "render/self_test.hpp"

#include <cstdio>

int main() {
    std::puts(grainbench::render::test_drawing().empty() ? "unknown" : "drawn");
}
