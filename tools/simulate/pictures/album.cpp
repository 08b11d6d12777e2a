#include "album.hpp"
#include "video.hpp"

#include "render/render.hpp"
#include "render/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>

namespace simulate {

using Eigen::Vector3f;

namespace {

constexpr uint32_t compared = 5; // pictures in a row of the comparison
constexpr uint32_t columns = 4;  // of the contact sheet
// A film of all that is compared is drawn smaller, and kept in memory until its last column is
// there.
constexpr uint32_t film_divisor = 3, film_share = 2; // of the pictures' size
constexpr float longest_film = 20.0f; // s; of longer runs the film shows the run alone

// `count` frames spread over all of them, the last one included.
std::set<uint32_t> spread(uint32_t count, uint32_t frames) {
    std::set<uint32_t> chosen;
    for (uint32_t i = 1; i <= count; ++i)
        chosen.insert((static_cast<uint32_t>(uint64_t{frames} * i / count)) -
                      (frames >= count ? 1 : 0));
    return chosen;
}

std::string caption(const Shot& shot) {
    char text[32];
    std::snprintf(text, sizeof text, "t = %.2f s", static_cast<double>(shot.time));
    return text + shot.level;
}

Vector3f towards_camera(const CameraChoice& choice, const Figure& figure) {
    const float radians = std::numbers::pi_v<float> / 180.0f;
    const float azimuth = figure.azimuth * radians, elevation = choice.elevation * radians;
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
            std::cos(azimuth) * std::cos(elevation)};
}

// The distance from the middle of `box` at which its corners just fit a view with these half
// angles.
float fitting_distance(const Eigen::AlignedBox3f& box, const Vector3f& back, float tan_x,
                       float tan_y) {
    const Vector3f right = Vector3f::UnitY().cross(back).normalized(), up = back.cross(right);
    float distance = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
        const auto which = static_cast<Eigen::AlignedBox3f::CornerType>(corner);
        const Vector3f p = box.corner(which) - box.center();
        const float needed = std::max(std::abs(p.dot(right)) / tan_x, std::abs(p.dot(up)) / tan_y);
        distance = std::max(distance, p.dot(back) + needed);
    }
    return distance;
}

// The hair at rest fits the picture with some room for its swing.
render::Camera fit_camera(const CameraChoice& choice, const PictureChoice& picture,
                          const Figure& figure) {
    constexpr float room = 1.12f;
    render::Camera camera;
    camera.field_of_view = choice.field_of_view;
    const float tan_y =
        std::tan(0.5f * choice.field_of_view * std::numbers::pi_v<float> / 180.0f) / room;
    const float aspect = static_cast<float>(picture.width) / static_cast<float>(picture.height);
    const Vector3f back = towards_camera(choice, figure);
    const float distance = fitting_distance(figure.hair_bounds, back, tan_y * aspect, tan_y);
    camera.target = choice.target ? Vector3f(choice.target->data()) : figure.hair_bounds.center();
    camera.eye = camera.target + back * distance / choice.zoom;
    if (choice.eye)
        camera.eye = Vector3f(choice.eye->data());
    return camera;
}

render::Look make_look(const PictureChoice& choice) {
    render::Look look;
    if (choice.hair_root)
        look.hair_root = Vector3f(choice.hair_root->data());
    if (choice.hair_tip)
        look.hair_tip = Vector3f(choice.hair_tip->data());
    return look;
}

std::vector<render::SheetRow> in_rows(const std::map<uint32_t, render::Cell>& cells) {
    std::vector<render::SheetRow> rows;
    for (const auto& [frame, cell] : cells) {
        if (rows.empty() || rows.back().cells.size() == columns)
            rows.emplace_back();
        rows.back().cells.push_back(cell);
    }
    return rows;
}

} // namespace

struct Album::State {
    const Scene& scene;
    const Figure& figure;
    render::Renderer renderer;
    render::Camera camera;
    render::Look look;
    std::set<uint32_t> sheet_frames, compared_frames;
    uint32_t video_every;
    std::unique_ptr<Video> video;                        // of the run alone, written as it goes
    std::vector<render::Image> film;                     // of the run, to be set beside the others
    std::vector<std::string> film_levels;                // as Shot::level
    std::vector<std::vector<render::Image>> beside_film; // by variant
    using Cells = std::map<uint32_t, render::Cell>;      // by frame
    Cells cells;
    std::vector<Variant> beside;
    std::vector<Cells> beside_cells; // by variant

    State(const Scene& s, const Figure& f, std::vector<Variant> variants);
    std::string path(const char* name) const { return scene.out + "/" + name; }
    render::Image draw(const Shot& shot, uint32_t samples, bool small = false);
    bool in_film(uint32_t frame) const { return frame % video_every == 0; }
    bool films_all() const;
    void write_film(std::vector<std::string>& files);
    std::string title() const;   // the groom, and the kind of hair if it is another
    std::string setting() const; // what all rows share
    void write_sheets(std::vector<std::string>& files) const;
    void write_comparison(std::vector<std::string>& files) const;
    render::SheetRow compared_row(const std::string& label, const Cells& from) const;
};

Album::State::State(const Scene& s, const Figure& f, std::vector<Variant> variants)
    : scene(s), figure(f), camera(fit_camera(s.camera, s.pictures, f)), look(make_look(s.pictures)),
      sheet_frames(spread(s.pictures.cells, s.frames())),
      compared_frames(spread(compared, s.frames())),
      video_every(std::max(1u, s.rate / std::min(s.rate, s.pictures.video_rate))),
      beside(std::move(variants)), beside_cells(beside.size()) {
    beside_film.resize(beside.size());
    if (s.pictures.video && !films_all())
        video = std::make_unique<Video>(path("motion"), s.pictures.width, s.pictures.height,
                                        static_cast<double>(s.rate) / video_every);
}

bool Album::State::films_all() const {
    const bool says_more = !beside.empty() || scene.changes_level();
    return scene.pictures.video && says_more && scene.seconds <= longest_film;
}

render::Image Album::State::draw(const Shot& shot, uint32_t samples, bool small) {
    const PictureChoice& choice = scene.pictures;
    const float width = choice.hair_width > 0.0f
                            ? choice.hair_width * shot.widen
                            : render::default_width(shot.vertex_count.size()) * figure.size;
    const render::Hair hair{shot.positions, shot.vertex_count, shot.row, width};
    // The head's pose is that of the step's end, and so must be the hands'.
    const float end = shot.time + 1.0f / static_cast<float>(scene.rate);
    const render::Mesh solids{figure.posed_solids(shot.head, end), figure.solids.triangles,
                              figure.solids.scalp};
    const auto side = [&](uint32_t pixels) {
        return static_cast<int>(small ? pixels * film_share / film_divisor : pixels);
    };
    const render::Frame frame{side(choice.width), side(choice.height), static_cast<int>(samples),
                              0};
    return renderer.draw(hair, solids, camera, look, frame);
}

std::string Album::State::setting() const {
    const std::string guides =
        figure.guides ? std::to_string(figure.simulated_strands()) + " guides of " : "";
    return guides + std::to_string(figure.info.strands) + " strands x " +
           std::to_string(figure.info.max_vertices) + ", " + scene.motion + ", " +
           std::to_string(scene.rate) + " Hz, " + std::to_string(scene.substeps) + " substeps";
}

std::string Album::State::title() const {
    const std::string groom = std::filesystem::path(scene.groom.name).filename().string();
    const bool same = scene.preset.empty() || scene.preset == groom;
    return "plait: " + groom + (same ? "" : ", " + scene.preset);
}

void Album::State::write_sheets(std::vector<std::string>& files) const {
    std::map<uint32_t, render::Cell> chosen;
    for (const auto& [frame, cell] : cells)
        if (sheet_frames.contains(frame))
            chosen.emplace(frame, cell);
    if (chosen.empty())
        return;
    render::write_sheet({title(), setting() + ", " + label_of(scene), in_rows(chosen)},
                        path("sheet.png"));
    files.push_back(path("sheet.png"));
}

render::SheetRow Album::State::compared_row(const std::string& label, const Cells& from) const {
    render::SheetRow row{label, {}};
    for (const uint32_t frame : compared_frames)
        if (const auto cell = from.find(frame); cell != from.end())
            row.cells.push_back(cell->second);
    return row;
}

void Album::State::write_comparison(std::vector<std::string>& files) const {
    std::vector<render::SheetRow> rows;
    const auto add = [&](const std::string& label, const Cells& from) {
        const char letter[] = {static_cast<char>('A' + rows.size()), ':', ' ', 0};
        rows.push_back(compared_row(letter + label, from));
    };
    for (size_t i = 0; i < beside.size(); ++i)
        if (!beside_cells[i].empty())
            add(beside[i].label, beside_cells[i]);
    if (rows.empty())
        return;
    add(label_of(scene), cells);
    const bool has_tressfx = std::ranges::any_of(
        beside, [](const Variant& v) { return v.sim.model == PLAIT_MODEL_TRESSFX; });
    render::write_sheet(
        {title(), has_tressfx ? setting() + "; " + tressfx_settings(scene) : setting(), rows},
        path("ab.png"));
    files.push_back(path("ab.png"));
}

// The columns that are whole: after Ctrl-C only the run's.
void Album::State::write_film(std::vector<std::string>& files) {
    if (film.empty())
        return;
    std::vector<const std::vector<render::Image>*> columns_of_film;
    std::vector<std::string> labels;
    for (size_t i = 0; i < beside.size(); ++i)
        if (beside_film[i].size() == film.size()) {
            columns_of_film.push_back(&beside_film[i]);
            labels.push_back(beside[i].short_label());
        }
    columns_of_film.push_back(&film);
    labels.push_back(short_label_of(scene.sim) + (scene.wetness.empty() ? "" : ", wet") +
                     (scene.crowd.directed() ? within(scene.crowd) : ""));
    std::unique_ptr<Video> out;
    for (size_t frame = 0; frame < film.size(); ++frame) {
        std::vector<render::Cell> side;
        for (size_t i = 0; i < columns_of_film.size(); ++i)
            side.push_back({(*columns_of_film[i])[frame],
                            std::string(1, static_cast<char>('A' + i)) + ": " + labels[i]});
        if (side.size() == 1)
            side[0].caption = labels[0];
        side.back().caption += film_levels[frame];
        const render::Image image = render::side_by_side(side);
        if (!out)
            out = std::make_unique<Video>(path("motion"), image.width, image.height,
                                          static_cast<double>(scene.rate) / video_every);
        out->add(image);
    }
    if (out->close())
        files.push_back(out->path());
}

std::string Album::why_not() {
    return "";
}

Album::Album(const Scene& scene, const Figure& figure, std::vector<Variant> beside)
    : state_(std::make_unique<State>(scene, figure, std::move(beside))) {}
Album::~Album() = default;

bool Album::wants(uint32_t frame) const {
    return state_->sheet_frames.contains(frame) || state_->compared_frames.contains(frame) ||
           (state_->scene.pictures.video && state_->in_film(frame));
}

void Album::take(const Shot& shot) {
    const PictureChoice& choice = state_->scene.pictures;
    if (state_->sheet_frames.contains(shot.frame) || state_->compared_frames.contains(shot.frame))
        state_->cells[shot.frame] = {state_->draw(shot, choice.samples), caption(shot)};
    if (!choice.video || !state_->in_film(shot.frame))
        return;
    if (state_->video)
        state_->video->add(state_->draw(shot, choice.video_samples));
    else {
        state_->film.push_back(state_->draw(shot, choice.video_samples, true));
        state_->film_levels.push_back(shot.level);
    }
}

bool Album::wants_beside(uint32_t frame) const {
    return state_->compared_frames.contains(frame) ||
           (state_->films_all() && state_->in_film(frame));
}

void Album::take_beside(size_t variant, const Shot& shot) {
    const PictureChoice& choice = state_->scene.pictures;
    if (state_->compared_frames.contains(shot.frame))
        state_->beside_cells[variant][shot.frame] = {state_->draw(shot, choice.samples),
                                                     caption(shot)};
    if (state_->films_all() && state_->in_film(shot.frame))
        state_->beside_film[variant].push_back(state_->draw(shot, choice.video_samples, true));
}

std::vector<std::string> Album::finish() {
    std::vector<std::string> files;
    state_->write_sheets(files);
    state_->write_comparison(files);
    if (state_->video && state_->video->close())
        files.push_back(state_->video->path());
    state_->write_film(files);
    return files;
}

} // namespace simulate
