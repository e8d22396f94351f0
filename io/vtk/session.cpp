#include "io/vtk/session.hpp"

#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <algorithm>

namespace grainbench::io {
namespace {

std::mutex& vtk_mutex() {
    static std::mutex mutex;
    return mutex;
}

}  // namespace

class VtkSession::Collector : public vtkOutputWindow {
public:
    static Collector* New();

    void DisplayText(const char*) override {}

    void DisplayErrorText(const char* text) override { keep(text); }

    void DisplayWarningText(const char*) override {}

    void DisplayGenericWarningText(const char*) override {}

    void DisplayDebugText(const char*) override {}

    const std::string& text() const { return text_; }

protected:
    Collector() = default;

private:
    void keep(const char* text) {
        if (text_.empty() && text != nullptr) {
            text_ = text;
        }
    }

    std::string text_;
};

vtkStandardNewMacro(VtkSession::Collector)

    VtkSession::VtkSession()
    : lock_(vtk_mutex()),
      before_(vtkOutputWindow::GetInstance()),
      collector_(vtkSmartPointer<Collector>::New()) {
    vtkOutputWindow::SetInstance(collector_);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // it prints each message as well
}

VtkSession::~VtkSession() {
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_INFO);  // VTK's default; it has no getter
    vtkOutputWindow::SetInstance(before_);
}

std::string VtkSession::error() const {
    // VTK says "ERROR: In file, line n\nclass (address): message": the place is of no use to users.
    std::string text = collector_->text();
    if (const std::size_t place_end = text.find("): "); place_end != std::string::npos) {
        text.erase(0, place_end + 3);
    }
    while (!text.empty() && text.back() == '\n') {
        text.pop_back();
    }
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

}  // namespace grainbench::io
