// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/jobs/figure_parts.hpp>

#include <fmt/format.h>

namespace yoke::cases {

namespace {

constexpr std::size_t most_rows = 20001;  // of the data

/// Those of the largest forces, as many as are told apart; without those that never touched, if any
/// did.
std::vector<ContactRecord> drawn_contacts(const LawRun& run) {
  std::vector<ContactRecord> kept = run.contacts;
  if (run.peak_force() > 0.0)
    std::erase_if(kept, [](const ContactRecord& c) { return c.peak_force == 0.0; });
  std::vector<std::string> names;
  for (const ContactRecord& c : kept) names.push_back(c.element);
  names = largest_of(names, [&](const std::string& name) {
    return std::ranges::find(kept, name, &ContactRecord::element)->peak_force;
  });
  std::erase_if(kept, [&](const ContactRecord& c) {
    return std::ranges::find(names, c.element) == names.end();
  });
  return kept;
}

/// Force and penetration of every contact that is drawn.
void write_contacts(const LawRun& run, const std::vector<ContactRecord>& drawn,
                    const std::filesystem::path& path) {
  const Table& samples = run.all();
  std::string text = "t_s";
  std::vector<std::pair<std::size_t, std::size_t>> columns;
  for (const ContactRecord& c : drawn) {
    columns.emplace_back(samples.index(c.element + ".normal_force_N"),
                         samples.index(c.element + ".penetration_m"));
    text += fmt::format(",{0}.normal_force_N,{0}.penetration_um", c.element);
  }
  const std::size_t time = samples.index("t_s");
  const std::size_t every = std::max<std::size_t>(1, (samples.rows() - 1) / (most_rows - 1));
  // The largest of the rows that one stands for: peaks of short impacts stay.
  const auto largest_of = [&](std::size_t first, std::size_t column) {
    double most = samples.value(first, column);
    for (std::size_t i = first + 1; i < std::min(first + every, samples.rows()); ++i)
      most = std::max(most, samples.value(i, column));
    return most;
  };
  for (std::size_t i = 0; i < samples.rows(); i += every) {
    fmt::format_to(std::back_inserter(text), "\n{:.9g}", samples.value(i, time));
    for (const auto& [force, penetration] : columns)
      fmt::format_to(std::back_inserter(text), ",{:.7g},{:.7g}", largest_of(i, force),
                     1e6 * std::max(0.0, largest_of(i, penetration)));
  }
  write_text(path, text);
}

/// The contact in which the largest force was recorded, from onset to release.
void write_hardest(const LawRun& run, const std::filesystem::path& path) {
  const Table& samples = run.all();
  std::string text = "t_s,penetration_um,force_N";
  const auto hardest = std::ranges::max_element(run.contacts, {}, &ContactRecord::peak_force);
  const auto force = samples[hardest->element + ".normal_force_N"];
  const auto penetration = samples[hardest->element + ".penetration_m"];
  const auto t = samples["t_s"];
  Eigen::Index peak = 0;
  force.maxCoeff(&peak);
  for (const ContactSpell& spell :
       contact_spells(run, samples, t[0], t[t.size() - 1], hardest->element)) {
    const auto first = static_cast<Eigen::Index>(spell.first);
    const auto last = static_cast<Eigen::Index>(spell.last);
    if (peak < first || peak >= last) continue;
    // A contact that lasts is thinned; the loop starts and ends at nothing.
    const Eigen::Index every = std::max<Eigen::Index>(1, (last - first) / 4000);
    text += fmt::format("\n{:.9g},0,0", t[first]);
    for (Eigen::Index i = first; i < last; i += every)
      text += fmt::format("\n{:.9g},{:.7g},{:.7g}", t[i], 1e6 * penetration[i], force[i]);
    text += fmt::format("\n{:.9g},0,0", t[last - 1]);
  }
  if (text.find('\n') == std::string::npos) {  // it lasts, or did from the start
    Eigen::Index first = peak, last = peak;
    while (first > 0 && force[first - 1] > 0.0) --first;
    while (last + 1 < force.size() && force[last + 1] > 0.0) ++last;
    const Eigen::Index every = std::max<Eigen::Index>(1, (last - first) / 4000);
    for (Eigen::Index i = first; i <= last; i += every)
      text += fmt::format("\n{:.9g},{:.7g},{:.7g}", t[i], 1e6 * penetration[i], force[i]);
  }
  write_text(path, text);
}

/// A panel for each law, all with the same axis: bouncing curves on one axis hide each other.
Figure law_panels(const Sheet& sheet, const std::string& name, const std::string& title,
                  const std::string& label, const std::vector<DrawnRun>& runs, const char* column) {
  std::vector<Panel> all;
  for (const DrawnRun& run : runs) {
    Panel panel{label, {}};
    std::size_t i = 0;
    for (const ContactRecord& c : run.contacts) {
      const std::string text = runs.size() == 1           ? c.element
                               : run.contacts.size() == 1 ? run.law
                                                          : run.law + ": " + c.element;
      panel.lines.push_back(panel_line(data_file("contact", run), c.element + column, text, i++));
    }
    all.push_back(panel);
  }
  Figure figure = panel_figure(sheet, name, title, all, false);
  // The largest value of all laws bounds every panel.
  std::string range = "  top = 0\n";
  for (const DrawnRun& run : runs)
    for (const ContactRecord& c : run.contacts)
      range +=
          fmt::format("  stats {} using {} nooutput; top = STATS_max > top ? STATS_max : top\n",
                      gnuplot_text(data_file("contact", run)), gnuplot_text(c.element + column));
  if (sheet.print()) range += "  if (top > 0) { set ytics round_step(top/4) }\n";
  // Room for the names above the peaks.
  const std::size_t names = runs.front().contacts.size();
  figure.body = range +
                fmt::format("  set yrange [0:top > 0 ? {:.2f}*top : 1]\n",
                            names > 1 ? 1.1 + 0.09 * static_cast<double>(names) : 1.05) +
                figure.body;
  return figure;
}

Figure hysteresis(const Sheet& sheet, const std::vector<DrawnRun>& runs, const std::string& title) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < runs.size(); ++i)
    lines.push_back(fmt::format("{} using \"penetration_um\":\"force_N\" title {} {}",
                                gnuplot_text(data_file("hardest", runs[i])),
                                gnuplot_text(runs[i].law.empty() ? "contact" : runs[i].law),
                                line_style(i)));
  return {
      .name = "hysteresis",
      .title = title,
      .width = sheet.print() ? sheet.width : 1000,
      .height = (sheet.print() ? sheet.width * 7 / 10 : 700) + 20 * static_cast<int>(runs.size()),
      .body = heading(sheet, title) +
              "  set key noenhanced below left vertical maxcols 1\n"
              "  set xlabel 'penetration [µm]'; set ylabel 'contact force [N]'\n"
              "  set xrange [0:*]; set yrange [0:*]\n" +
              plot_of(lines),
      .sheet = sheet};
}

}  // namespace

void write_contact_data(const LawRun& run, const std::filesystem::path& folder, DrawnRun& drawn) {
  drawn.contacts = drawn_contacts(run);
  if (run.contacts.empty()) return;
  write_contacts(run, drawn.contacts, folder / data_file("contact", drawn));
  write_hardest(run, folder / data_file("hardest", drawn));
}

std::vector<Figure> contact_figures(const std::string& case_name, const std::vector<DrawnRun>& runs,
                                    const Sheet& sheet) {
  if (runs.front().contacts.empty()) return {};
  return {law_panels(sheet, "contact_force", case_name + ": contact force", "[N]", runs,
                     ".normal_force_N"),
          law_panels(sheet, "penetration", case_name + ": penetration", "[µm]", runs,
                     ".penetration_um"),
          hysteresis(sheet, runs, case_name + ": the contact with the largest force")};
}

}  // namespace yoke::cases
