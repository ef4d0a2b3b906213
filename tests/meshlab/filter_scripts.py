"""Filter scripts for meshlabserver, made from those that come with the plugin."""
import pathlib
import xml.etree.ElementTree as xml

SHIPPED = pathlib.Path(__file__).resolve().parents[2] / "meshlab_plugin/scripts"


def shipped_filter(name, **values):
    """The filter of a script that comes with the plugin, with some parameters changed."""
    filter_element = xml.parse(SHIPPED / f"{name}.mlx").getroot().find("filter")
    for parameter, value in values.items():
        found = [p for p in filter_element if p.get("name") == parameter]
        if not found:
            raise KeyError(f"{name}.mlx has no parameter {parameter}")
        found[0].set("value", str(value).lower() if isinstance(value, bool) else str(value))
    return filter_element


def stock_filter(name, *parameters):
    """A filter of MeshLab's own; parameters are (type, name, attributes)."""
    filter_element = xml.Element("filter", name=name)
    for kind, parameter, attributes in parameters:
        xml.SubElement(filter_element, "Param", type=kind, name=parameter, **attributes)
    return filter_element


def write_script(path, *filters):
    script = xml.Element("FilterScript")
    script.extend(filters)
    path.write_text("<!DOCTYPE FilterScript>\n" + xml.tostring(script, encoding="unicode"))
    return path
