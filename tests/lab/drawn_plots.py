"""What Bokeh holds and draws on a page, and where that is on the screen."""

_NAMED = """const named = (name) =>
    Bokeh.documents.map((each) => each.get_model_by_name(name)).find((each) => each);"""
_HELD = f"""([name, paths]) => {{
    {_NAMED}
    const plain = (each) => ArrayBuffer.isView(each) ? [...each]
        : Array.isArray(each) ? each.map(plain) : each;
    return paths.map((path) =>
        plain(path.split(".").reduce((of, key) => of[key], named(name))));
}}"""
_FRAME = f"""(name) => {{
    {_NAMED}
    const root = named(name);
    if (!(root?.inner_width > 0)) return null;
    const place = document.querySelector(`#plot-${{name}}`);
    place.scrollIntoView({{block: "center", behavior: "instant"}});
    const {{frame, canvas_view}} = Bokeh.index.find_one(root);
    const {{left, top}} = canvas_view.events_el.getBoundingClientRect(), {{bbox}} = frame;
    return {{left: left + bbox.left, top: top + bbox.top, width: bbox.width, height: bbox.height}};
}}"""
_STILL = f"""(name) => {{
    const now = ({_FRAME})(name), text = JSON.stringify(now);
    const {{still = 0, at}} = window.rest ?? {{}};
    window.rest = {{still: now && text === at ? still + 1 : 0, at: text}};
    return window.rest.still >= 3 && now;
}}"""
_PLACES = f"""([name, points]) => {{
    {_NAMED}
    const {{frame, canvas_view}} = Bokeh.index.find_one(named(name));
    const {{left, top}} = canvas_view.events_el.getBoundingClientRect();
    return points.map(([x, y]) =>
        [left + frame.x_scale.compute(x), top + frame.y_scale.compute(y)]);
}}"""
_VALUES = f"""([name, places]) => {{
    {_NAMED}
    const {{frame, canvas_view}} = Bokeh.index.find_one(named(name));
    const {{left}} = canvas_view.events_el.getBoundingClientRect();
    return places.map((place) => frame.x_scale.invert(place - left));
}}"""


def held(page, name, *paths):
    """Return attributes of what Bokeh has by a name, such as "location" or "x_range.start"."""
    return page.evaluate(_HELD, [name, list(paths)])


def source(page, name):
    """Return x and y of what is drawn."""
    return held(page, name, "data.x", "data.y")


def image(page, name):
    """Return the numbers of a map as Bokeh has them."""
    return held(page, name, "data.image")[0][0]


def still(page, plot):
    """Bring a plot to the middle of the window; return its frame when it has rested there."""
    page.evaluate("() => { window.rest = null; }")
    return page.wait_for_function(_STILL, arg=plot).json_value()


def on_screen(page, plot, *points):
    """Return where points of a plot are on the screen."""
    still(page, plot)
    return page.evaluate(_PLACES, [plot, points])


def values(page, plot, *places):
    """Return the values on the axis x of a plot at places on the screen."""
    return page.evaluate(_VALUES, [plot, places])


def drag(page, *places):
    """Drag the mouse through places on the screen."""
    page.mouse.move(*places[0])
    page.mouse.down()
    for place in places[1:]:
        page.mouse.move(*place, steps=4)
    page.mouse.up()
