#include <castor/castor.hpp>
#include <castor/perception/vision/types.hpp>

#include <fstream>

class Photographer : public castor::UnmanagedComponent {
  castor::Option<std::string> file_{this, "file", "picture.ppm", "where the picture goes"};

  void run() override {
    auto frame = pull<castor::vision::CameraFrame>("camera");
    auto& image = frame->image;
    std::ofstream file{file_.get(), std::ios::binary};
    file << "P6 " << image.width << ' ' << image.height << " 255\n";
    for (std::size_t i = 0; i + 2 < image.bytes.size(); i += 3) // From blue, green, red.
      file << image.bytes[i + 2] << image.bytes[i + 1] << image.bytes[i];
    info("wrote {} of {} x {} pixels", file_.get(), image.width, image.height);
  }
};
CASTOR_COMPONENT(Photographer, "writes one picture of the camera to a file")
