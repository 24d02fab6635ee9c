#include <seiche/core/base/error.hpp>
#include <seiche/figure/html.hpp>
#include <seiche/figure/report_figure.hpp>

#include <fmt/format.h>

namespace seiche {

std::string report_figure(const std::filesystem::path& folder, const ReportFigure& figure) {
  const std::filesystem::path figures = folder / "figures";
  std::string files;
  for (const std::string& format : figure.formats) {
    const std::string name = figure.stem + "." + format;
    if (std::filesystem::exists(figures / name))
      files += fmt::format(" <a href=\"figures/{}\">{}</a>", html_escaped(name), format);
  }
  const std::string number = figure.number.empty() ? "" : "<b>" + html_escaped(figure.number) + ".</b> ";
  const std::string caption = fmt::format("<figcaption>{}{} <span class=\"files\">{}</span></figcaption></figure>\n",
                                          number, html_text(figure.caption), files);
  const std::string open = figure.anchor.empty() ? "<figure>" : fmt::format("<figure id=\"{}\">", figure.anchor);
  try {
    const PngPicture light = read_png(figures / (figure.stem + ".png"));
    const PngPicture dark = read_png(figures / (figure.stem + "_dark.png"));
    return fmt::format(
        "{}<div class=\"drawn\"><picture><source media=\"(prefers-color-scheme: dark)\" srcset=\"{}\"><img src=\"{}\" "
        "width=\"{}\" height=\"{}\" alt=\"{}\"></picture></div>{}",
        open, dark.data_uri, light.data_uri, light.width, light.height, html_escaped(figure.title), caption);
  } catch (const Error&) {
    return open + "<div class=\"missing\">" + html_escaped(figure.title) + ": not drawn</div>" + caption;
  }
}

}  // namespace seiche
