// The styles of everything that is loaded later, in an order in which later ones may refine earlier ones.
import "./timeline.css";
import "./shaping.css";
import "./panels.css";
import "./controls.css";
import "./widgets.css";
import "./architecture.css";
import "./brush.css";
import "./looks.css";
import "./sun.css";
import "./branch.css";
import "./sheet-contents.css";
import "./library.css";
import "./finding.css";
import "./collections.css";
import "./help.css";
import "./recent.css";
import "./vain.css";
