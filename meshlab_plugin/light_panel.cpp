// Controls of the live view: what kind of light, and sliders that turn and brighten it.
#include "meshlab_plugin/light_panel.h"

#include <QComboBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QVBoxLayout>
#include <algorithm>

namespace shbake::meshlab {
namespace {

/// Steps of a slider to one power of 2.
constexpr double kExposureSteps = 20;
/// Steps of a slider to one unit of irradiance, or to the whole of an albedo.
constexpr double kFineSteps = 100;

/// A value that goes round: -180..180.
int wrapped(int degrees) {
  return (degrees % 360 + 540) % 360 - 180;
}

}  // namespace

LightPanel::LightPanel(QWidget* parent, std::function<void()> changed)
    : QDialog(parent, Qt::Tool), changed_(std::move(changed)) {
  setWindowTitle(QStringLiteral("SH Relight"));
  auto* layout = new QVBoxLayout(this);
  kind_ = new QComboBox;
  for (const std::string& name : lightKindNames()) kind_->addItem(QString::fromStdString(name));
  layout->addWidget(kind_);
  file_ = new QPushButton(QStringLiteral("Choose a file..."));
  file_->setToolTip(QStringLiteral("An image of an environment map, or a .shlight file"));
  layout->addWidget(file_);
  rotation_ = addSlider(*layout, "Rotation", "Turns the light about the up axis", -180, 180, 0);
  altitude_ = addSlider(*layout, "Sun altitude", "Of the sun or the disc, above the horizon", 0, 90, 45);
  sun_ = addSlider(*layout, "Sun", "What the sun adds to a sky", 0, static_cast<int>(10 * kFineSteps), 0);
  ground_ = addSlider(*layout, "Ground", "Albedo of the ground below a sky", 0, static_cast<int>(kFineSteps), 0);
  exposure_ = addSlider(*layout, "Exposure", "Brightens the picture", static_cast<int>(-6 * kExposureSteps),
                        static_cast<int>(6 * kExposureSteps), 0);
  up_ = new QComboBox;
  up_->addItems({QStringLiteral("z points up"), QStringLiteral("y points up")});
  layout->addWidget(up_);
  words_ = new QLabel(QStringLiteral("Ctrl+Shift and drag in the view to turn the light."));
  words_->setWordWrap(true);
  words_->setMinimumWidth(260);
  layout->addWidget(words_);

  const auto pick = QOverload<int>::of(&QComboBox::activated);
  connect(kind_, pick, this, [this](int kind) {
    if (static_cast<LightKind>(kind) == LightKind::file && path_.empty()) return chooseFile();
    changed_();
  });
  connect(up_, pick, this, [this] { changed_(); });
  connect(file_, &QPushButton::clicked, this, [this] { chooseFile(); });
}

QSlider* LightPanel::addSlider(QVBoxLayout& layout, const QString& name, const QString& help, int least, int most,
                               int value) {
  auto* row = new QFormLayout;
  auto* slider = new QSlider(Qt::Horizontal);
  slider->setRange(least, most);
  slider->setValue(value);
  slider->setToolTip(help);
  slider->setObjectName(name);
  row->addRow(name, slider);
  layout.addLayout(row);
  connect(slider, &QSlider::valueChanged, this, [this] { changed_(); });
  return slider;
}

void LightPanel::chooseFile() {
  const QString path = QFileDialog::getOpenFileName(this, QStringLiteral("Light"), QString::fromStdString(path_),
                                                    QStringLiteral("Light (*.hdr *.exr *.shlight *.png *.jpg *.tif)"));
  if (path.isEmpty()) return;
  path_ = path.toStdString();
  file_->setText(QFileInfo(path).fileName());
  kind_->setCurrentIndex(static_cast<int>(LightKind::file));
  changed_();
}

LightChoice LightPanel::choice() const {
  LightChoice choice;
  choice.kind = static_cast<LightKind>(kind_->currentIndex());
  choice.file = path_;
  choice.turn = rotation_->value();
  choice.sunAltitude = altitude_->value();
  choice.sunIrradiance = sun_->value() / kFineSteps;
  choice.ground = ground_->value() / kFineSteps;
  choice.up = up_->currentIndex() == 0 ? UpAxis::z : UpAxis::y;
  return choice;
}

double LightPanel::exposure() const {
  return exposure_->value() / kExposureSteps;
}

void LightPanel::drag(double turn, double rise) {
  rotation_->setValue(wrapped(rotation_->value() + static_cast<int>(turn)));
  altitude_->setValue(altitude_->value() + static_cast<int>(rise));
}

void LightPanel::say(const QString& sentence) {
  words_->setText(sentence);
}

}  // namespace shbake::meshlab
