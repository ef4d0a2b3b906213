// The window with the controls of the live view.
#pragma once

#include <QDialog>
#include <functional>

#include "meshlab_plugin/light_choice.h"

class QComboBox;
class QLabel;
class QPushButton;
class QSlider;
class QVBoxLayout;

namespace shbake::meshlab {

class LightPanel : public QDialog {
 public:
  /// `changed` is called whenever a control has moved.
  LightPanel(QWidget* parent, std::function<void()> changed);

  LightChoice choice() const;
  /// What is added to the automatic exposure, as a power of 2.
  double exposure() const;

  /// Turns the light by degrees about the up axis and towards the zenith, as dragging in the view does.
  void drag(double turn, double rise);
  /// Shows a sentence below the controls.
  void say(const QString& sentence);

 private:
  QSlider* addSlider(QVBoxLayout& layout, const QString& name, const QString& help, int least, int most, int value);
  void chooseFile();

  std::function<void()> changed_;
  QComboBox *kind_ = nullptr, *up_ = nullptr;
  QPushButton* file_ = nullptr;
  QSlider *rotation_ = nullptr, *altitude_ = nullptr, *sun_ = nullptr, *ground_ = nullptr, *exposure_ = nullptr;
  QLabel* words_ = nullptr;
  std::string path_;
};

}  // namespace shbake::meshlab
