# Install and export, so that find_package(grainbench COMPONENTS core) works.
