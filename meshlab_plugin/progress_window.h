// A window that tells how far long work is and can cancel it, which MeshLab's own progress bar cannot.
#pragma once

#include <QProgressDialog>
#include <QString>
#include <memory>
#include <string>

namespace shbake::meshlab {

/// Shows nothing where MeshLab has no window, as in meshlabserver. While it is shown it blocks clicks elsewhere, so
/// that the layer cannot be closed or changed under the work. For the thread of the user interface.
class ProgressWindow {
 public:
  explicit ProgressWindow(const QString& title);
  ~ProgressWindow();

  /// Shows the state and handles clicks. False once Cancel has been pressed.
  bool show(int percent, const std::string& text);

 private:
  std::unique_ptr<QProgressDialog> dialog_;
};

}  // namespace shbake::meshlab
