# What render links: libpng, and the VTK modules that draw. For the build and for consumers of the installed component render.
set(grainbench_vtk_drawing_components
    ChartsCore CommonColor CommonTransforms FiltersCore FiltersSources IOExport IOImage
    RenderingAnnotation RenderingContext2D RenderingContextOpenGL2 RenderingCore RenderingFreeType
    RenderingOpenGL2)
find_package(PNG REQUIRED)
find_package(VTK 9.1 REQUIRED COMPONENTS
    CommonCore CommonDataModel IOCore IOGeometry IOXML IOXMLParser ${grainbench_vtk_drawing_components})
set(grainbench_vtk_drawing ${grainbench_vtk_drawing_components})
list(TRANSFORM grainbench_vtk_drawing PREPEND VTK::)
