/// One use of VTK: keeps other threads out and collects what VTK would print, so that messages end
/// in our errors and never on the terminal. Private to io: this header shows VTK.
#pragma once

#include <vtkSmartPointer.h>

#include <mutex>
#include <string>

class vtkOutputWindow;

namespace grainbench::io {

class VtkSession {
public:
    VtkSession();
    ~VtkSession();
    VtkSession(const VtkSession&) = delete;
    VtkSession& operator=(const VtkSession&) = delete;

    /// First error since the start on one line, empty if there was none.
    std::string error() const;

private:
    class Collector;

    std::scoped_lock<std::mutex> lock_;
    vtkSmartPointer<vtkOutputWindow> before_;
    vtkSmartPointer<Collector> collector_;
};

}  // namespace grainbench::io
