#include "airsim360/dataset/gallery/gallery.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/log.h"
#include "airsim360/base/parallel.h"
#include "airsim360/dataset/folder.h"
#include "airsim360/dataset/gallery/scene_legend.h"
#include "airsim360/dataset/gallery/statistics.h"
#include "airsim360/image/codecs.h"
#include "airsim360/image/draw.h"

namespace airsim360 {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr int kWidest = 1024;  // of the pictures drawn for the page

uint8_t Byte(double v) { return static_cast<uint8_t>(std::lround(std::clamp(v, 0.0, 1.0) * 255)); }

// Blue (near 0) over green to red.
Rgb8 Rainbow(double t) {
  const auto hump = [](double x) { return std::clamp(1.5 - std::abs(x), 0.0, 1.0); };
  return {Byte(hump(4 * t - 3)), Byte(hump(4 * t - 2)), Byte(hump(4 * t - 1))};
}

Rgb8 FlowColor(float dx, float dy) {
  const double angle = std::atan2(dy, dx), size = std::min(1.0, std::hypot(dx, dy) / 32.0);
  const auto channel = [&](double turn) { return Byte(1 - size * (0.5 - 0.5 * std::cos(angle - turn))); };
  return {channel(0), channel(2 * std::numbers::pi / 3), channel(4 * std::numbers::pi / 3)};
}

template <class Pixel, class Color>
Image<Rgb8> Drawn(const Image<Pixel>& image, const Color& color) {
  // Every n-th pixel is enough to look at.
  const int step = std::max(1, (image.width() + kWidest - 1) / kWidest);
  Image<Rgb8> drawn(image.width() / step, image.height() / step);
  for (int y = 0; y < drawn.height(); ++y) {
    for (int x = 0; x < drawn.width(); ++x) drawn(x, y) = color(image(x * step, y * step), x * step, y * step);
  }
  return drawn;
}

Image<Rgb8> DrawRange(const Image<float>& range) {
  return Drawn(range, [](float r, int, int) { return r <= 0 ? Rgb8{} : Rainbow(1 - std::log10(std::clamp(r, 0.5f, 500.0f) * 2) / 3); });
}

// Whether a browser shows the file as it is.
bool ShowsAsIs(const std::string& product, const std::string& extension) {
  return extension != ".exr" && product != "entity" && product != "material" && product != "part";
}

Image<Rgb8> DrawProduct(const NativeDataset& data, const NativeFrame& frame, const View& view, const std::string& product) {
  if (product == "range") return DrawRange(data.Range(frame, view));
  const auto by_id = [](auto id, int, int) { return IdColor(id); };
  if (product == "entity") return Drawn(data.Entity(frame, view), by_id);
  const Bytes stored = data.Read(frame, view, product);
  const std::string name = product + "/" + data.FileName(frame, view, product);
  if (product == "material" || product == "part") return Drawn(DecodeGrayPng(stored, name), by_id);
  if (product == "coverage")
    return Drawn(DecodeExrChannel(stored, name, "id.0"), [](float id, int, int) { return IdColor(static_cast<uint32_t>(id)); });
  if (product == "flow") {
    const Image<float> dy = DecodeExrChannel(stored, name, "dy");
    return Drawn(DecodeExrChannel(stored, name, "dx"), [&](float dx, int x, int y) { return FlowColor(dx, dy(x, y)); });
  }
  if (product == "position") {
    const auto wave = [](float v) { return Byte(v - std::floor(v)); };
    const Image<float> py = DecodeExrChannel(stored, name, "Y"), pz = DecodeExrChannel(stored, name, "Z");
    return Drawn(DecodeExrChannel(stored, name, "X"), [&](float px, int x, int y) {
      return Rgb8{wave(px / 10), wave(py(x, y) / 10), wave(pz(x, y) / 10)};
    });
  }
  return Drawn(DecodeExrRgb(stored, name), [](Rgb32f c, int, int) {
    const auto tone = [](float v) { return Byte(std::sqrt(v / (1 + v))); };
    return Rgb8{tone(c.r), tone(c.g), tone(c.b)};
  });
}

// Draws what must be drawn and gives the page's entry of a frame.
Json FrameEntry(const NativeDataset& data, size_t position, const fs::path& pictures) {
  const NativeFrame frame = data.Frame(position);
  Json files = Json::object();
  for (const ProductFolder& product : ProductFolders(data.spec())) {
    for (const View& view : data.views()) {
      const std::string key = product.name + view.suffix;
      if (ShowsAsIs(product.name, product.extension)) {
        files[key] = product.name + "/" + data.FileName(frame, view, product.name);
        continue;
      }
      const std::string name = frame.stem + view.suffix + "_" + product.name + ".jpg";
      const Image<Rgb8> drawn = DrawProduct(data, frame, view, product.name);
      WriteFileAtomically(pictures / name, EncodeJpeg(drawn, 90));
      files[key] = "gallery/" + name;
    }
  }
  const Vec3d p = frame.X_WC(data.views().front()).p;
  return {{"stem", frame.stem},
          {"world", frame.world},
          {"t", 1e-9 * static_cast<double>(frame.t_ns)},
          {"p", {p.x, p.y, p.z}},
          {"range", frame.json.value("range_median", 0.0)},
          {"files", files}};
}

std::string Escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else
      safe += c;
  }
  return safe;
}

// JSON inside a script must not close it.
std::string ScriptJson(const Json& json) {
  std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace), safe;
  for (const char c : text) safe += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return safe;
}

std::string Legend(const NativeDataset& data, const internal::DatasetStatistics& statistics) {
  std::string text;
  for (const auto& [id, count] : statistics.categories) {
    const NativeCategory& c = data.category(id);
    text += "<span><i style=\"background:rgb(" + std::to_string(c.color.r) + "," + std::to_string(c.color.g) + "," +
            std::to_string(c.color.b) + ")\"></i>" + Escaped(c.path) + "</span>\n";
  }
  return text;
}

// Of each world a picture with its categories.
std::string Scenes(const internal::DatasetStatistics& statistics) {
  std::string text;
  for (const auto& [world, count] : statistics.worlds) {
    text += "<figure class=scene><figcaption>" + Escaped(world) + "</figcaption><img src=\"gallery/" + internal::SceneLegendName(world) +
            "\" alt=\"colour, categories and legend of " + Escaped(world) + "\"></figure>\n";
  }
  return text;
}

constexpr char kHead[] = R"(<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<link rel="icon" href="data:,">
<style>body{font:15px sans-serif;margin:1em;background:#fafafa;color:#222}#pictures{display:grid;grid-template-columns:repeat(auto-fill,minmax(420px,1fr));gap:12px}
figure{margin:0}.scene{max-width:1024px;margin:0 0 1em}figcaption{font-weight:600;padding:2px 0}img{width:100%;display:block;background:#ddd}input[type=range]{width:60%;vertical-align:middle}
#legend span{display:inline-block;margin-right:1em}#legend i{display:inline-block;width:1em;height:1em;margin-right:.3em;vertical-align:-2px;border:1px solid #888}
pre{white-space:pre-wrap}</style><title>)";

constexpr char kScript[] = R"(
const slider = document.getElementById('frame'), about = document.getElementById('about'), box = document.getElementById('pictures');
slider.max = frames.length - 1;
function show(i) {
  const f = frames[i];
  slider.value = i;
  about.textContent = `frame ${f.stem} (${i + 1} of ${frames.length}), ${f.world}, t = ${f.t.toFixed(2)} s, at ${f.p.map(v => v.toFixed(2)).join(', ')} m, median range ${f.range.toFixed(1)} m`;
  box.replaceChildren(...Object.entries(f.files).map(([name, file]) => {
    const figure = document.createElement('figure'), caption = document.createElement('figcaption'), link = document.createElement('a'), image = document.createElement('img');
    caption.textContent = name; image.src = file; image.alt = name + ' of frame ' + f.stem; link.href = file; link.append(image); figure.append(caption, link);
    return figure;
  }));
}
const step = by => show(Math.min(frames.length - 1, Math.max(0, +slider.value + by)));
slider.addEventListener('input', () => show(+slider.value));
document.getElementById('back').addEventListener('click', () => step(-1));
document.getElementById('on').addEventListener('click', () => step(1));
document.addEventListener('keydown', e => { if (e.target === slider) return; if (e.key === 'ArrowLeft') step(-1); if (e.key === 'ArrowRight') step(1); });
show(0);
)";

std::string Page(const NativeDataset& data, const internal::DatasetStatistics& statistics, const Json& frames) {
  const std::string title = Escaped(data.spec().world) + ": " + std::to_string(data.size()) + " frames";
  return kHead + title + "</title><h1>" + title +
         "</h1>\n<p><button id=back aria-label=\"previous frame\">&larr;</button> "
         "<input type=range id=frame min=0 value=0 aria-label=\"frame\"> <button id=on aria-label=\"next frame\">&rarr;</button></p>\n"
         "<p id=about></p><div id=pictures></div>\n<h2>Scenes</h2>" +
         Scenes(statistics) + "<h2>Categories</h2><p id=legend>" + Legend(data, statistics) + "</p>\n<h2>Card</h2><pre>" +
         Escaped(internal::StatisticsMarkdown(data, statistics)) + "</pre>\n<script>const frames = " + ScriptJson(frames) + ";" + kScript +
         "</script></html>\n";
}

}  // namespace

DatasetCard CardOfDataset(const fs::path& folder) {
  const NativeDataset data(folder);
  const internal::DatasetStatistics statistics = internal::CountDataset(data);
  return {internal::StatisticsMarkdown(data, statistics), internal::StatisticsJson(data, statistics).dump()};
}

fs::path WriteGallery(const fs::path& folder) {
  const NativeDataset data(folder);
  const fs::path pictures = folder / "gallery";
  CreateWritableFolder(pictures);
  const FolderLock lock(folder);
  const internal::DatasetStatistics statistics = internal::CountDataset(data);
  std::vector<Json> entries(data.size());
  ProgressBar progress("gallery", static_cast<int64_t>(entries.size()));
  constexpr size_t kBatch = 16;
  for (size_t begin = 0; begin < entries.size(); begin += kBatch) {
    const size_t n = std::min(kBatch, entries.size() - begin);
    ParallelFor(static_cast<int64_t>(n), [&](int64_t i) {
      const size_t k = begin + static_cast<size_t>(i);
      entries[k] = FrameEntry(data, k, pictures);
    });
    progress.Update(static_cast<int64_t>(begin + n));
  }
  for (const auto& [world, count] : statistics.worlds)
    WriteFileAtomically(pictures / internal::SceneLegendName(world), EncodePng(internal::DrawSceneLegend(data, statistics, world)));
  const fs::path page = folder / "index.html";
  WriteFileAtomically(page, Page(data, statistics, Json(entries)));
  return page;
}

}  // namespace airsim360
