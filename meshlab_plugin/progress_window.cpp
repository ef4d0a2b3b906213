// A modal progress dialog over MeshLab's main window.
#include "meshlab_plugin/progress_window.h"

#include <QApplication>
#include <QMainWindow>

namespace shbake::meshlab {
namespace {

QMainWindow* mainWindow() {
  for (QWidget* widget : QApplication::topLevelWidgets()) {
    auto* window = qobject_cast<QMainWindow*>(widget);
    if (window != nullptr && window->isVisible()) return window;
  }
  return nullptr;
}

}  // namespace

ProgressWindow::ProgressWindow(const QString& title) {
  QMainWindow* parent = mainWindow();
  if (parent == nullptr) return;
  dialog_ = std::make_unique<QProgressDialog>(title, QStringLiteral("Cancel"), 0, 100, parent);
  dialog_->setWindowTitle(title);
  dialog_->setWindowModality(Qt::ApplicationModal);
  dialog_->setAutoClose(false);
  dialog_->setAutoReset(false);
  dialog_->setMinimumWidth(360);
  dialog_->show();
}

ProgressWindow::~ProgressWindow() = default;

bool ProgressWindow::show(int percent, const std::string& text) {
  if (!dialog_) return true;
  dialog_->setLabelText(QString::fromStdString(text));
  dialog_->setValue(percent);  // handles clicks, being modal
  QApplication::processEvents();
  return !dialog_->wasCanceled();
}

}  // namespace shbake::meshlab
