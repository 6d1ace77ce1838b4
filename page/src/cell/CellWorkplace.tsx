// The workplace "Cell": the live solver behind sliders.
export function CellWorkplace() {
  return (
    <section class="cell" aria-label="Cell">
      <p>The cell.</p>
    </section>
  );
}
