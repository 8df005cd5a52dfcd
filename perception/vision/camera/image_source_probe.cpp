#include "castor/perception/vision/camera/image_source_probe.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <string_view>

namespace castor::vision {

namespace {

/// Numbers and texts at places in a file; beyond its end there are zeros.
class Bytes {
public:
  explicit Bytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
    // nop
  }

  std::size_t size() const { return bytes_.size(); }

  std::uint8_t operator[](std::size_t i) const { return i < bytes_.size() ? bytes_[i] : 0; }

  std::uint32_t big(std::size_t at, int count) const {
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i)
      value = value << 8 | (*this)[at + static_cast<std::size_t>(i)];
    return value;
  }

  std::uint32_t little(std::size_t at, int count) const {
    std::uint32_t value = 0;
    for (int i = count; i-- > 0;)
      value = value << 8 | (*this)[at + static_cast<std::size_t>(i)];
    return value;
  }

  bool has(std::size_t at, std::string_view text) const {
    if (at > size() || size() - at < text.size())
      return false;
    return std::equal(text.begin(), text.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(at),
                      [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
  }

  std::span<const std::uint8_t> part(std::size_t at, std::size_t count) const {
    return bytes_.subspan(at, count);
  }

private:
  std::span<const std::uint8_t> bytes_;
};

/// The checksum of a PNG's chunk (ISO 3309, polynomial 0xEDB88320).
std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
  static const auto table = [] {
    std::array<std::uint32_t, 256> values{};
    for (std::uint32_t i = 0; i < values.size(); ++i) {
      values[i] = i;
      for (int bit = 0; bit < 8; ++bit)
        values[i] = values[i] & 1 ? 0xEDB88320 ^ values[i] >> 1 : values[i] >> 1;
    }
    return values;
  }();
  std::uint32_t crc = 0xFFFFFFFF;
  for (const auto byte : bytes)
    crc = table[(crc ^ byte) & 0xFF] ^ crc >> 8;
  return ~crc;
}

ImageProbe probe_png(const Bytes& file) {
  ImageProbe probe{ImageFormat::png, file.big(16, 4), file.big(20, 4), false};
  // Each chunk: length, type, that many bytes, checksum of type and bytes.
  for (std::size_t at = 8; file.size() - at >= 12;) {
    const std::size_t length = file.big(at, 4);
    if (length > file.size() - at - 12)
      break;
    if (crc32(file.part(at + 4, length + 4)) != file.big(at + 8 + length, 4))
      break;
    if (file.has(at + 4, "IEND")) {
      probe.complete = true;
      break;
    }
    at += length + 12;
  }
  return probe;
}

ImageProbe probe_jpeg(const Bytes& file) {
  ImageProbe probe{ImageFormat::jpeg, 0, 0, false};
  for (std::size_t at = 2; at + 1 < file.size();) {
    if (file[at] != 0xFF) {
      // Within the coded picture, up to the next marker.
      ++at;
      continue;
    }
    const std::uint8_t marker = file[at + 1];
    if (marker == 0xD9) {
      probe.complete = probe.width > 0;
      break;
    }
    const bool stands_alone =
      marker == 0x00 || marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8);
    if (marker == 0xFF || stands_alone) {
      at += marker == 0xFF ? 1 : 2;
      continue;
    }
    const bool is_frame_header =
      marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (is_frame_header && probe.width == 0) {
      probe.height = file.big(at + 5, 2);
      probe.width = file.big(at + 7, 2);
    }
    at += 2 + std::max<std::size_t>(2, file.big(at + 2, 2));
  }
  return probe;
}

ImageProbe probe_bmp(const Bytes& file) {
  ImageProbe probe{ImageFormat::bmp, 0, 0, false};
  if (file.size() < 26)
    return probe;
  std::uint64_t bits = 24;
  std::uint32_t compression = 0;
  if (file.little(14, 4) == 12) {
    probe.width = file.little(18, 2);
    probe.height = file.little(20, 2);
    bits = file.little(24, 2);
  } else {
    const auto height = static_cast<std::int32_t>(file.little(22, 4));
    probe.width = file.little(18, 4);
    // A negative height means rows from the top.
    probe.height = static_cast<std::uint64_t>(height < 0 ? -std::int64_t{height} : height);
    bits = file.little(28, 2);
    compression = file.little(30, 4);
  }
  if (probe.width > 0x7FFFFFFF)
    probe.width = 0;
  const bool rows_are_raw = compression == 0 || compression == 3;
  const std::uint64_t row = (probe.width * std::min<std::uint64_t>(bits, 64) + 31) / 32 * 4;
  const std::uint64_t begin = file.little(10, 4);
  probe.complete = file.size() > begin &&
                   (!rows_are_raw || row == 0 || (file.size() - begin) / row >= probe.height);
  return probe;
}

/// Whether there are nothing but numbers and comments from `at` on.
bool is_numbers(const Bytes& file, std::size_t at) {
  bool in_comment = false;
  for (; at < file.size(); ++at) {
    in_comment = file[at] == '#' || (in_comment && file[at] != '\n');
    if (!in_comment && std::isspace(file[at]) == 0 && std::isdigit(file[at]) == 0)
      return false;
  }
  return true;
}

ImageProbe probe_pnm(const Bytes& file) {
  ImageProbe probe{ImageFormat::pnm, 0, 0, false};
  std::size_t at = 2;
  const auto number = [&]() -> std::uint64_t {
    while (at < file.size() && (std::isspace(file[at]) != 0 || file[at] == '#')) {
      if (file[at] == '#')
        while (at < file.size() && file[at] != '\n')
          ++at;
      else
        ++at;
    }
    std::uint64_t value = 0;
    for (; at < file.size() && std::isdigit(file[at]) != 0 && value < 1'000'000'000; ++at)
      value = 10 * value + static_cast<std::uint64_t>(file[at] - '0');
    return value;
  };
  const char kind = static_cast<char>(file[1]);
  probe.width = number();
  probe.height = number();
  const bool is_bitmap = kind == '1' || kind == '4';
  const std::uint64_t highest = is_bitmap ? 1 : number();
  const std::uint64_t samples = probe.width * (kind == '3' || kind == '6' ? 3 : 1);
  std::uint64_t row = samples * (highest > 255 ? 2 : 1);
  if (kind == '4')
    row = (probe.width + 7) / 8;
  else if (kind < '4')
    // In text, each number has a digit at least.
    row = samples;
  const std::uint64_t left = file.size() > at + 1 ? file.size() - at - 1 : 0;
  const bool is_sound = highest >= 1 && highest <= 65535 && (kind >= '4' || is_numbers(file, at));
  probe.complete = is_sound && row > 0 && left / row >= probe.height;
  return probe;
}

ImageProbe probe_webp(const Bytes& file) {
  ImageProbe probe{ImageFormat::webp, 0, 0, false};
  probe.complete = file.size() >= std::size_t{file.little(4, 4)} + 8;
  if (file.has(12, "VP8X")) {
    probe.width = file.little(24, 3) + 1;
    probe.height = file.little(27, 3) + 1;
  } else if (file.has(12, "VP8L")) {
    const std::uint32_t sizes = file.little(21, 4);
    probe.width = (sizes & 0x3FFF) + 1;
    probe.height = (sizes >> 14 & 0x3FFF) + 1;
  } else if (file.has(12, "VP8 ")) {
    probe.width = file.little(26, 2) & 0x3FFF;
    probe.height = file.little(28, 2) & 0x3FFF;
  }
  return probe;
}

ImageProbe probe_tiff(const Bytes& file) {
  ImageProbe probe{ImageFormat::tiff, 0, 0, false};
  const bool is_little = file[0] == 'I';
  const auto number = [&](std::size_t at, int count) {
    return is_little ? file.little(at, count) : file.big(at, count);
  };
  const std::size_t directory = number(4, 4);
  const std::size_t entries = number(directory, 2);
  for (std::size_t i = 0; i < entries && directory + 2 + 12 * i < file.size(); ++i) {
    const std::size_t at = directory + 2 + 12 * i;
    const std::uint32_t tag = number(at, 2);
    const std::uint32_t value = number(at + 8, number(at + 2, 2) == 3 ? 2 : 4);
    if (tag == 256)
      probe.width = value;
    else if (tag == 257)
      probe.height = value;
  }
  probe.complete = probe.width > 0 && probe.height > 0;
  return probe;
}

} // namespace

std::optional<ImageProbe> probe_image(std::span<const std::uint8_t> bytes) {
  const Bytes file(bytes);
  if (file.has(0, "\x89PNG\r\n\x1A\n"))
    return probe_png(file);
  if (file.has(0, "\xFF\xD8\xFF"))
    return probe_jpeg(file);
  if (file.has(0, "BM"))
    return probe_bmp(file);
  if (file[0] == 'P' && file[1] >= '1' && file[1] <= '6' && std::isspace(file[2]) != 0)
    return probe_pnm(file);
  if (file.has(0, "RIFF") && file.has(8, "WEBP"))
    return probe_webp(file);
  using namespace std::string_view_literals;
  if (file.has(0, "II*\0"sv) || file.has(0, "MM\0*"sv))
    return probe_tiff(file);
  return std::nullopt;
}

} // namespace castor::vision
