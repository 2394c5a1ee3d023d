/** Parameters of growth: each one's name, and what it does in a sentence. */
export const PARAMETERS = {
  "parameters.vigor_model": ["Vigor model", "Wuchskraft-Modell"],
  "parameters.vigor_model.help": [
    "How the force to grow is shared out among branches.",
    "Wie die Kraft zum Wachsen unter den Ästen verteilt wird.",
  ],
  "parameters.vigor_model.borchert_honda": ["Borchert–Honda", "Borchert–Honda"],
  "parameters.vigor_model.priority": ["Priority", "Rangfolge"],
  "parameters.apical_control": ["Apical dominance", "Apikaldominanz"],
  "parameters.apical_control.help": [
    "High: one straight trunk; low: a crown that spreads.",
    "Hoch: ein durchgehender Stamm; niedrig: eine ausladende Krone.",
  ],
  "parameters.maturity_steps": ["Time to mature", "Reifezeit"],
  "parameters.maturity_steps.help": [
    "Over so many steps a tree’s apical dominance changes; 0 means never.",
    "Über so viele Schritte ändert sich die Apikaldominanz; 0 heißt nie.",
  ],
  "parameters.maturity_start": ["Maturing begins", "Beginn der Reife"],
  "parameters.maturity_start.help": [
    "So many steps after its seed a tree begins to mature.",
    "So viele Schritte nach der Saat beginnt ein Baum zu reifen.",
  ],
  "parameters.mature_apical_control": ["Dominance when mature", "Dominanz im Alter"],
  "parameters.mature_apical_control.help": [
    "What apical dominance has turned into when the tree is mature.",
    "Wohin sich die Apikaldominanz bis zur Reife ändert.",
  ],
  "parameters.priority_least_weight": ["Least weight", "Kleinstes Gewicht"],
  "parameters.priority_least_weight.help": [
    "What the last in the ranking of an axis still counts.",
    "Was der Letzte in der Rangfolge einer Achse noch zählt.",
  ],
  "parameters.priority_decline": ["Decline", "Abfall"],
  "parameters.priority_decline.help": [
    "Over which share of the ranking weights fall to the least.",
    "Über welchen Teil der Rangfolge die Gewichte zum kleinsten fallen.",
  ],
  "parameters.light_sensitivity": ["Sensitivity to light", "Lichtempfindlichkeit"],
  "parameters.light_sensitivity.help": [
    "High: only buds in bright light grow; 0: light does not matter.",
    "Hoch: nur Knospen in hellem Licht wachsen; 0: Licht zählt nicht.",
  ],
  "parameters.max_shoot_length": ["Longest shoot", "Längster Trieb"],
  "parameters.max_shoot_length.help": [
    "How many internodes the most vigorous bud adds in a step; many make wispy branches.",
    "Wie viele Internodien die kräftigste Knospe je Schritt bildet; viele machen rutige Zweige.",
  ],
  "parameters.vigor_gain": ["Vigor gain", "Wuchskraft"],
  "parameters.vigor_gain.help": [
    "How much vigor the whole tree gets out of its light.",
    "Wie viel Kraft der ganze Baum aus seinem Licht gewinnt.",
  ],
  "parameters.shedding_threshold": ["Shedding", "Astabwurf"],
  "parameters.shedding_threshold.help": [
    "Branches with less vigor for their size are shed; 0 keeps them all.",
    "Äste mit weniger Kraft für ihre Größe fallen ab; 0 behält alle.",
  ],
  "parameters.heading_weight": ["Straight on", "Geradeaus"],
  "parameters.heading_weight.help": [
    "How strongly a shoot keeps its present direction.",
    "Wie stark ein Trieb seine Richtung beibehält.",
  ],
  "parameters.tropism_weight": ["Tropism", "Tropismus"],
  "parameters.tropism_weight.help": [
    "How strongly shoots turn towards their set-point angle.",
    "Wie stark Triebe sich ihrem Sollwinkel zuwenden.",
  ],
  "parameters.space_weight": ["Free space", "Freier Raum"],
  "parameters.space_weight.help": [
    "How strongly shoots turn to where there is room.",
    "Wie stark Triebe sich dorthin wenden, wo Platz ist.",
  ],
  "parameters.setpoint_angle": ["Set-point angle", "Sollwinkel"],
  "parameters.setpoint_angle.help": [
    "The angle to the vertical that branches tend to keep: 0° rise, 90° level, 180° weep.",
    "Der Winkel zur Senkrechten, den Äste anstreben: 0° aufrecht, 90° waagrecht, 180° hängend.",
  ],
  "parameters.trunk_upward": ["Trunk always upward", "Stamm immer aufwärts"],
  "parameters.trunk_upward.help": [
    "The trunk rises whatever its branches do, as of conifers.",
    "Der Stamm steigt auf, was immer die Äste tun, wie bei Nadelbäumen.",
  ],
  "parameters.tropism_from_stroke": ["Tropism from the stroke", "Tropismus aus dem Strich"],
  "parameters.tropism_from_stroke.help": [
    "Branches tend along your brush stroke, which suits hanging trees.",
    "Äste streben entlang des Pinselstrichs; gut für hängende Bäume.",
  ],
  "parameters.phototropism": ["Phototropism", "Phototropismus"],
  "parameters.phototropism.help": [
    "How far shoots prefer the light to mere free space.",
    "Wie sehr Triebe das Licht dem bloßen freien Raum vorziehen.",
  ],
  "parameters.branching_angle": ["Branching angle", "Verzweigungswinkel"],
  "parameters.branching_angle.help": [
    "The angle between a side bud and the axis that bears it.",
    "Der Winkel zwischen einer Seitenknospe und ihrer Achse.",
  ],
  "parameters.phyllotactic_angle": ["Phyllotaxis", "Blattstellung"],
  "parameters.phyllotactic_angle.help": [
    "How far around the axis one bud stands from the next.",
    "Wie weit um die Achse eine Knospe von der nächsten steht.",
  ],
  "parameters.buds_per_node": ["Buds at a node", "Knospen je Knoten"],
  "parameters.buds_per_node.help": [
    "1 is alternate, 2 opposite, more are whorled.",
    "1 ist wechselständig, 2 gegenständig, mehr stehen im Quirl.",
  ],
  "parameters.deflection_angle": ["Deflection", "Ablenkung"],
  "parameters.deflection_angle.help": [
    "How far an axis turns away from the bud it has just passed: zigzag growth.",
    "Wie weit eine Achse von der eben passierten Knospe abbiegt: Zickzackwuchs.",
  ],
  "parameters.gravimorphism_vertical": ["Half-axis, vertical", "Halbachse, senkrecht"],
  "parameters.gravimorphism_vertical.help": [
    "Half the height of the ellipse: buds above and below a slanted branch.",
    "Halbe Höhe der Ellipse: Knospen über und unter einem schrägen Ast.",
  ],
  "parameters.gravimorphism_horizontal": ["Half-axis, level", "Halbachse, waagrecht"],
  "parameters.gravimorphism_horizontal.help": [
    "Half the width of the ellipse: buds on the flanks of a slanted branch.",
    "Halbe Breite der Ellipse: Knospen an den Flanken eines schrägen Asts.",
  ],
  "parameters.gravimorphism_shift": ["Shift", "Verschiebung"],
  "parameters.gravimorphism_shift.help": [
    "Above 0 buds on the upper side are favoured, below 0 those underneath.",
    "Über 0 sind Knospen oben im Vorteil, unter 0 jene unten.",
  ],
  "parameters.occupancy_radius": ["Occupied zone", "Besetzte Zone"],
  "parameters.occupancy_radius.help": [
    "The radius a bud keeps for itself: large makes an open crown.",
    "Der Umkreis, den eine Knospe für sich behält: groß macht eine lichte Krone.",
  ],
  "parameters.perception_depth": ["Depth of perception", "Blickweite"],
  "parameters.perception_depth.help": [
    "How far beyond its own zone a bud looks for free space.",
    "Wie weit jenseits ihrer Zone eine Knospe freien Raum sucht.",
  ],
  "parameters.perception_angle": ["Angle of perception", "Blickwinkel"],
  "parameters.perception_angle.help": [
    "How wide a bud looks: narrow grows straight, wide turns anywhere.",
    "Wie weit der Blick einer Knospe ist: eng wächst sie gerade, weit überallhin.",
  ],
  "parameters.marker_density": ["Marker density", "Markerdichte"],
  "parameters.marker_density.help": [
    "How many markers of free space brush and lasso sow: more make denser wood.",
    "Wie viele Raummarker Pinsel und Lasso säen: mehr machen dichteres Holz.",
  ],
  "parameters.markers_per_bud": ["Markers for a bud", "Marker je Knospe"],
  "parameters.markers_per_bud.help": [
    "How many markers a bud perceives while the tree grows by itself.",
    "Wie viele Marker eine Knospe wahrnimmt, wenn der Baum von selbst wächst.",
  ],
  "parameters.marker_max_age": ["Marker age", "Markeralter"],
  "parameters.marker_max_age.help": [
    "How many steps growth lingers where the brush has been.",
    "Wie viele Schritte es dort weiterwächst, wo der Pinsel war.",
  ],
  "parameters.shadow_strength": ["Shadow", "Schatten"],
  "parameters.shadow_strength.help": [
    "How much light each piece of a branch takes from what is below.",
    "Wie viel Licht jedes Aststück dem nimmt, was darunter ist.",
  ],
  "parameters.shadow_decay": ["Fading", "Abklingen"],
  "parameters.shadow_decay.help": [
    "How fast a shadow fades with every internode downwards.",
    "Wie schnell ein Schatten mit jedem Internodium nach unten schwindet.",
  ],
  "parameters.shadow_depth": ["Reach of shadows", "Reichweite der Schatten"],
  "parameters.shadow_depth.help": [
    "How many internodes down a shadow reaches.",
    "Wie viele Internodien ein Schatten hinabreicht.",
  ],
  "parameters.internode_length": ["Internode", "Internodium"],
  "parameters.internode_length.help": [
    "Its true length, which sets the size of what you export.",
    "Seine wahre Länge; sie bestimmt die Größe beim Export.",
  ],
  "parameters.girth_exponent": ["Girth exponent", "Dickenexponent"],
  "parameters.girth_exponent.help": [
    "Low: limbs thicken quickly towards the trunk; high: they stay slender.",
    "Niedrig: Äste werden zum Stamm hin rasch dick; hoch: sie bleiben schlank.",
  ],
  "parameters.twig_diameter": ["Twigs", "Zweige"],
  "parameters.twig_diameter.help": [
    "How thick a twig is at its tip, in internodes.",
    "Wie dick ein Zweig an der Spitze ist, in Internodien.",
  ],
  "parameters.leaves_per_node": ["Leaves at a node", "Blätter je Knoten"],
  "parameters.leaves_per_node.help": [
    "How many leaves each node of a twig bears.",
    "Wie viele Blätter jeder Zweigknoten trägt.",
  ],
  "parameters.leaf_size": ["Leaf length", "Blattlänge"],
  "parameters.leaf_size.help": ["How long a leaf is, in internodes.", "Wie lang ein Blatt ist, in Internodien."],
  "parameters.unit.steps": ["steps", "Schritte"],
} as const;
