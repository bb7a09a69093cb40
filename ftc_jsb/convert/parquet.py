"""Apache Parquet: a column a variable, its unit and meaning in the schema."""

from pathlib import Path

from ftc_jsb.recording.flight import Flight


def write(flight: Flight, path: Path) -> None:
    """Write every variable; the file's metadata are the recording's attributes."""
    import pyarrow
    from pyarrow import parquet

    from ftc_jsb.recording.dataset import to_dataset

    dataset = to_dataset(flight)
    names = ["time", *(str(name) for name in dataset.data_vars)]
    fields = [
        pyarrow.field(name, pyarrow.float64(), metadata=dict(dataset[name].attrs)) for name in names
    ]
    attributes = {str(name): str(value) for name, value in dataset.attrs.items()}
    schema = pyarrow.schema(fields, metadata=attributes)
    columns = [dataset[name].to_numpy() for name in names]
    parquet.write_table(pyarrow.Table.from_arrays(columns, schema=schema), path)
