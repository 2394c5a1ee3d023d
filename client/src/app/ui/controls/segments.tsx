interface SegmentsProps {
  readonly legend: string;
  readonly name: string;
  readonly values: readonly string[];
  readonly chosen: string;
  readonly text: (value: string) => string;
  readonly onChoose: (value: string) => void;
}

/** One of several, below one another. */
export function Segments({ legend, name, values, chosen, text, onChoose }: SegmentsProps) {
  return (
    <fieldset class="segments stacked">
      <legend>{legend}</legend>
      {values.map((value) => (
        <label key={value}>
          <input type="radio" name={name} checked={chosen === value} onChange={() => onChoose(value)} />
          <span>{text(value)}</span>
        </label>
      ))}
    </fieldset>
  );
}
